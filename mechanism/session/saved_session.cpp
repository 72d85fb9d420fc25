// The data that a session saves: counts that identify the model, the fractions of its loads, the report of the last
// step, and the state or the motion in progress.
#include <stdexcept>

#include "mechanism/session/session.hpp"
#include "mechanism/system/check_state.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

[[noreturn]] void refuse(const std::string& why = "") {
  throw InputError("the state to be restored was not saved by a session of this model in this version" +
                   (why.empty() ? "" : ": " + why));
}

void exchange_report(Archive& archive, std::optional<StepRecord>& report, int equations) {
  bool there = report.has_value();
  archive(there);
  if (!there) return;
  if (!report) report.emplace();
  Energy& energy = report->energy;
  for (double* value : {&energy.kinetic, &energy.elastic, &energy.gravity, &energy.dissipation, &energy.input,
                        &report->balance, &report->step, &report->error_estimate, &report->worst_residual})
    archive.shown(*value);
  archive(report->newton_iterations);
  archive.within(report->worst_equation, -1, equations - 1);
  bool timed = report->time.has_value();
  archive(timed);
  if (timed) archive(report->time ? *report->time : report->time.emplace());
}

/// Restores data from numbers, and reports numbers that are not as expected.
template <class Read>
auto restored(Archive& archive, Read&& read) {
  std::string why = "there are more numbers than are needed";
  try {
    auto result = read();
    if (archive.exhausted()) return result;
  } catch (const std::out_of_range& error) {
    why = error.what();
  }
  refuse(why);
}

}  // namespace

struct Session::Saved {
  Loaded loaded;
  Environment acting;
  std::optional<StepRecord> report;
  bool moving = false, started = false;
  State state;  ///< the state, if there is no motion
};

void Session::exchange(Archive& archive, Saved& saved) const {
  for (const std::size_t count :
       {model_.nodes().size(), model_.members().size(), static_cast<std::size_t>(system_.dofs()),
        static_cast<std::size_t>(system_.size()), static_cast<std::size_t>(state_.memory.size())}) {
    auto number = static_cast<double>(count);
    archive(number);
    if (number != static_cast<double>(count)) refuse();  // the numbers belong to another model
  }
  archive(saved.loaded.factor);
  archive(saved.loaded.motions);
  archive(saved.acting.gravity);
  archive(saved.acting.load_factor);
  archive(saved.acting.statics);
  exchange_report(archive, saved.report, system_.size());
  archive(saved.moving);
  archive(saved.started);
  if (saved.moving) return;
  archive(saved.state);
  archive(saved.state.motion_factor);
  if (archive.restoring()) check_state(system_, saved.state);
}

std::vector<double> Session::save() {
  Archive archive;
  Saved saved{loaded_, acting_, report_, motion_ != nullptr, started_, *shown_};
  exchange(archive, saved);
  if (motion_) motion_->write(archive, nullptr), motion_->anchored_ = false;
  return archive.values();
}

void Session::restore(const std::vector<double>& values) {
  Archive archive(values);
  Saved saved{loaded_, environment_, {}, false, false, state_};
  Motion::Parts parts = restored(archive, [&] {
    exchange(archive, saved);
    if (saved.moving && !motion_)
      throw InputError(
          "the state to be restored is in motion, and no motion is under way: start a motion from the saved state");
    Motion::Parts read = saved.moving ? motion_->read(archive, nullptr) : Motion::Parts();
    read.steps = read.saves = 0;
    if (saved.moving && archive.exhausted()) recorder_.step_recorders().set(read.gathered);
    return read;
  });
  if (saved.moving) {
    motion_->parts_ = std::move(parts);
    motion_->saved_ = motion_->anchored_ = motion_->last_recorded_ = false;
    motion_->show();
  } else {
    at_rest();
    state_ = std::move(saved.state);
  }
  loaded_ = saved.loaded;
  acting_ = saved.acting;
  report_ = saved.report;
  started_ = saved.started;
}

Motion Session::dynamics(const DynamicsOptions& options, const std::vector<double>& values) {
  Archive archive(values);
  Saved saved{loaded_, environment_, {}, false, false, state_};
  try {
    exchange(archive, saved);
  } catch (const std::out_of_range& error) {
    refuse(error.what());
  }
  if (!saved.moving) throw InputError("the saved state is not in motion: restore it, and start a motion");
  return Motion(*this, options, archive, nullptr, saved.report);
}

}  // namespace bielle::mechanism
