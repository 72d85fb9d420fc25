#include "reduce/distributed/ranks/team.hpp"

#include <algorithm>
#include <chrono>
#include <new>
#include <thread>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

namespace {

constexpr int tag = 1;
constexpr std::size_t most_bytes = std::size_t{1} << 30;  // MPI counts in 32 bits

void send_bytes(const char* data, std::size_t bytes, int to, MPI_Comm comm) {
  const std::uint64_t count = bytes;
  MPI_Send(&count, 1, MPI_UINT64_T, to, tag, comm);
  for (std::size_t first = 0; first < bytes; first += most_bytes)
    MPI_Send(data + first, static_cast<int>(std::min(most_bytes, bytes - first)), MPI_BYTE, to, tag, comm);
}

/// Receives into a string or a vector of numbers.
template <class Container>
void receive_bytes(Container& data, int from, MPI_Comm comm) {
  std::uint64_t count = 0;
  MPI_Recv(&count, 1, MPI_UINT64_T, from, tag, comm, MPI_STATUS_IGNORE);
  data.resize(count / sizeof(data[0]));
  char* const start = reinterpret_cast<char*>(data.data());
  for (std::size_t first = 0; first < count; first += most_bytes)
    MPI_Recv(start + first, static_cast<int>(std::min(most_bytes, count - first)), MPI_BYTE, from, tag, comm,
             MPI_STATUS_IGNORE);
}

Outcome outcome_of(const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const std::bad_alloc&) {
    return {Outcome::out_of_memory, "out of memory"};
  } catch (const ComputationError& error) {
    return {Outcome::failed, error.what()};
  }
}

}  // namespace

Team::Team(MPI_Comm comm, Channel* channel) : comm_(comm), channel_(channel) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &size_);
}

Order Team::next() {
  std::int64_t numbers[3] = {static_cast<std::int64_t>(Command::leave), -1, 0};
  if (leads() && !channel_->receive_if_any(numbers, sizeof numbers)) numbers[1] = -1;
  MPI_Request request;
  MPI_Ibcast(numbers, 3, MPI_INT64_T, 0, comm_, &request);
  // MPI's own waiting occupies the processor, which bielle-reduce needs at that time.
  auto pause = std::chrono::microseconds(10);
  for (int done = 0, tries = 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE), !done; ++tries) {
    if (tries < 200) continue;
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(1000));
  }
  return {static_cast<Command>(numbers[0]), numbers[1], numbers[2]};
}

void Team::all_or_none(const std::function<void()>& work) {
  Outcome outcome = outcome_of(work);
  int first = outcome.kind == Outcome::good ? size_ : rank_;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm_);
  if (first == size_) return;
  MPI_Bcast(&outcome.kind, 1, MPI_INT64_T, first, comm_);
  auto length = static_cast<std::uint64_t>(outcome.message.size());
  MPI_Bcast(&length, 1, MPI_UINT64_T, first, comm_);
  outcome.message.resize(length);
  MPI_Bcast(outcome.message.data(), static_cast<int>(length), MPI_CHAR, first, comm_);
  throw RankFailure{outcome};
}

std::vector<double> Team::share_numbers() { return std::move(share_blocks(1).front()); }

std::pair<std::vector<double>, std::vector<double>> Team::share_two_blocks() {
  std::vector<std::vector<double>> blocks = share_blocks(2);
  return {std::move(blocks[0]), std::move(blocks[1])};
}

std::vector<std::vector<double>> Team::share_blocks(int count) {
  std::vector<std::vector<double>> own(static_cast<std::size_t>(count));
  if (!leads()) {
    for (std::vector<double>& block : own) receive_bytes(block, 0, comm_);
    return own;
  }
  std::vector<double> other;
  for (int to = 0; to < size_; ++to) {
    for (std::vector<double>& block : own) {
      std::vector<double>& target = to == 0 ? block : other;
      target.resize(static_cast<std::size_t>(channel_->receive_number<std::int64_t>()));
      channel_->receive(target.data(), sizeof(double) * target.size());
      if (to > 0) send_bytes(reinterpret_cast<const char*>(other.data()), sizeof(double) * other.size(), to, comm_);
    }
  }
  return own;
}

std::string Team::share_text() {
  std::string own;
  if (!leads()) {
    receive_bytes(own, 0, comm_);
    return own;
  }
  own = channel_->receive_text();
  for (int to = 1; to < size_; ++to) {
    const std::string text = channel_->receive_text();
    send_bytes(text.data(), text.size(), to, comm_);
  }
  return own;
}

void Team::collect_numbers(const std::vector<double>& block) {
  if (!leads()) {
    send_bytes(reinterpret_cast<const char*>(block.data()), sizeof(double) * block.size(), 0, comm_);
    return;
  }
  std::vector<double> other;
  for (int from = 0; from < size_; ++from) {
    if (from > 0) receive_bytes(other, from, comm_);
    const std::vector<double>& numbers = from == 0 ? block : other;
    channel_->send_number(static_cast<std::int64_t>(numbers.size()));
    channel_->send(numbers.data(), sizeof(double) * numbers.size());
  }
}

void Team::add_up(double* values, std::size_t count) {
  constexpr std::size_t most = std::size_t{1} << 27;
  for (std::size_t first = 0; first < count; first += most) {
    const int width = static_cast<int>(std::min(most, count - first));
    MPI_Reduce(leads() ? MPI_IN_PLACE : values + first, values + first, width, MPI_DOUBLE, MPI_SUM, 0, comm_);
  }
}

}  // namespace bielle::reduce
