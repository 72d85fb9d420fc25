#include "mechanism/python/working_session.hpp"

#include <algorithm>
#include <stdexcept>

#include "mechanism/python/texts.hpp"
#include "mechanism/python/without_lock.hpp"

namespace bielle::python {

using mechanism::Motion;
using mechanism::Recording;
using mechanism::Session;

WorkingSession::WorkingSession(HeldModel model, int threads) : model_(std::move(model)) {
  const SingleBlasThread one;
  const WithoutLock free;
  session_ = std::make_unique<Session>(model_->model, threads);
  session_->set_notes(&notes_);
  session_->set_recording(model_->output.recording);
  session_->on_step([this](Session&) {
    if (listener_) listener_->step();
  });
  session_->on_event([this](const mechanism::Event& event) {
    if (listener_) listener_->event(event.time, event.name);
  });
}

/// The files compute results of components in their own threads, which must end before the session does.
WorkingSession::~WorkingSession() {
  for (const auto& [recorder, before] : recorders_) recorder->file.reset();
}

WorkingSession::Listening::Listening(WorkingSession& of, const Callbacks& callbacks)
    : session(of), interruptible(of.gate_.get(), &callbacks) {
  session.listener_ = &interruptible;
}

/// Keeps each message once, because a motion with thousands of starts would repeat it.
void WorkingSession::KeptNotes::note(const std::string& sentence) {
  std::string shown = without_unseen_lines(sentence);
  if (std::find(sentences.begin(), sentences.end(), shown) == sentences.end()) sentences.push_back(std::move(shown));
}

void WorkingSession::attach(const std::shared_ptr<Recorder>& recorder, Recording recording, bool memory) {
  const Callbacks none;
  compute(none, [&](Session& session) {
    close_motion(session);
    const Recording before = session.recording();
    session.set_recording(std::move(recording));
    recorders_.emplace_back(recorder, before);
    if (recorder->file) session.add_sink(*recorder->file);
    if (memory) session.add_sink(recorder->memory);
    if (session.moving()) open_motion(session, 0);
  });
}

void WorkingSession::detach(const std::shared_ptr<Recorder>& recorder) {
  const auto found =
      std::find_if(recorders_.begin(), recorders_.end(), [&](const auto& each) { return each.first == recorder; });
  if (found == recorders_.end()) return;
  const Callbacks none;
  compute(none, [&](Session& session) {
    const bool was_open = open_;
    close_motion(session);
    session.set_recording(found->second);
    session.remove_sink(recorder->memory);
    if (recorder->file) {
      session.remove_sink(*recorder->file);
      recorder->file->complete();
      recorder->file.reset();
    }
    recorders_.erase(found);
    if (was_open && !recorders_.empty() && session.moving()) open_motion(session, 0);
  });
}

void WorkingSession::open_motion(Session& session, std::size_t expected_rows) {
  if (recorders_.empty()) return;
  session.begin_analysis("dynamic", expected_rows);
  open_ = true;
}

void WorkingSession::close_motion(Session& session) {
  if (!open_) return;
  open_ = false;
  session.end_analysis();
}

void WorkingSession::abandon(Session& session) {
  open_ = false;
  session.abandon_analysis();
}

void WorkingSession::bury(std::unique_ptr<Motion> motion) {
  if (gate_->computing()) ended_.push_back(std::move(motion));
}

}  // namespace bielle::python
