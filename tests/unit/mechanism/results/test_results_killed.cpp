// The file of a run that is killed by SIGKILL, at any moment.
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include "results_sample.hpp"
#include <catch2/catch.hpp>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "reduce/common/files/hdf5_file.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::ResultsSample;
using bielle::test::TemporaryFolder;
using namespace std::chrono_literals;

namespace {

/// A child process, which tells the moments of an action by bytes on a pipe.
class Child {
 public:
  explicit Child(const std::function<void(int pipe)>& action) {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    process_ = fork();
    REQUIRE(process_ >= 0);
    if (process_ == 0) {
      close(ends[0]);
      action(ends[1]);
      _exit(0);
    }
    close(ends[1]);
    pipe_ = ends[0];
  }
  ~Child() { close(pipe_); }
  Child(const Child&) = delete;

  /// Returns whether a byte came before the end of the process.
  bool wait_for_byte() const {
    char byte = 0;
    return read(pipe_, &byte, 1) == 1;
  }
  void kill_it() const { kill(process_, SIGKILL); }
  /// Waits for the end. Returns the status.
  int end() const {
    int status = 0;
    waitpid(process_, &status, 0);
    return status;
  }

 private:
  pid_t process_ = 0;
  int pipe_ = 0;
};

/// Runs `action` in a child process and kills that after `delay`, counted from its first byte on the pipe it is given.
void run_and_kill(std::chrono::microseconds delay, const std::function<void(int pipe)>& action) {
  const Child child(action);
  const bool told = child.wait_for_byte();
  std::this_thread::sleep_for(delay);
  child.kill_it();
  const int status = child.end();
  REQUIRE(told);
  REQUIRE(WIFSIGNALED(status));
}

/// Returns the time between the two bytes of an action that runs to its end. It runs in a child process: this process
/// keeps no memory of the HDF5 library, each page of which would be copied when a later child frees it.
std::chrono::microseconds time_between_bytes(const std::function<void(int pipe)>& action) {
  const Child child(action);
  const bool first = child.wait_for_byte();
  const auto began = std::chrono::steady_clock::now();
  const bool second = child.wait_for_byte();
  const auto ended = std::chrono::steady_clock::now();
  const int status = child.end();
  REQUIRE(first);
  REQUIRE(second);
  REQUIRE(status == 0);
  return std::chrono::duration_cast<std::chrono::microseconds>(ended - began);
}

void tell(int pipe) {
  if (write(pipe, "x", 1) != 1) _exit(1);
}

/// The numbers of an entry, by the place that each layout gives them.
std::vector<double> read(const Hdf5File& file, const std::string& named, const std::string& stacked,
                         std::size_t number) {
  if (file.read_text_attribute("/", "layout") == "named") return file.read(named);
  const Shape shape = file.shape(stacked);
  std::size_t size = 1;
  for (std::size_t k = 2; k < shape.size(); ++k) size *= shape[k];
  const std::vector<double> all = file.read(stacked);
  std::vector<double> values;
  for (std::size_t row = 0; row < shape[0]; ++row)
    for (std::size_t k = 0; k < size; ++k) values.push_back(all[(row * shape[1] + number) * size + k]);
  return values;
}

/// Every row that /time counts must be whole: sample row i has time 0.5 i.
std::size_t check_rows(const std::string& path) {
  const Hdf5File file = Hdf5File::open(path);
  REQUIRE(file.read_integer_attribute("/", "complete") == 0);
  if (!file.has("/time")) return 0;
  const std::vector<double> time = file.read("/time"),
                            position = read(file, "/nodes/tip/position", "/nodes/node/position", 1),
                            strain = read(file, "/elements/shaft/strain", "/elements/beam/strain", 0),
                            step = file.read("/solver/step");
  REQUIRE(position.size() >= 3 * time.size());
  REQUIRE(strain.size() >= 12 * time.size());
  REQUIRE(step.size() >= time.size());
  std::size_t whole = 0;
  for (; whole < time.size(); ++whole) {
    const double number = static_cast<double>(whole);
    if (time[whole] != 0.5 * number || position[3 * whole + 1] != number) break;
    if (strain[12 * whole + 11] != 3050 + 0.5 * number || step[whole] != 0.5) break;
  }
  REQUIRE(whole == time.size());
  return time.size();
}

/// Kills runs while they record, at moments that are spread over 190 ms.
void kill_while_recording(ResultsLayout layout, int moments) {
  const TemporaryFolder folder;
  CAPTURE(layout_name(layout));
  std::size_t most = 0;
  for (int trial = 0; trial < 24; trial += 24 / moments) {
    const std::string path = folder / "run.h5";
    run_and_kill(trial * 8ms + trial * 37us, [&](int pipe) {
      ResultsSample sample;
      ResultsFile results(path, sample.model, "", layout);
      constexpr int rows = 50'000;
      results.begin_analysis("dynamic", rows);
      sample.record(results, 0);
      tell(pipe);
      for (int i = 1; i < rows; ++i) sample.record(results, i);
      std::this_thread::sleep_for(1h);
    });
    INFO("trial " << trial);
    most = std::max(most, check_rows(path));
  }
  CHECK(most > 1000);
}

/// Kills runs while they make the datasets of many nodes.
void kill_while_datasets_are_made(ResultsLayout layout, int nodes, int trials) {
  const TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  // 2000 datasets by names take some 100 ms to make: kills are spread over this time, and beyond.
  CAPTURE(layout_name(layout));
  const auto sample_model = [nodes] {
    Model model;
    for (int k = 0; k < nodes; ++k) {
      Node node;
      node.name = "node number " + std::to_string(k);
      node.frame.x = Vector3(k, 0, 0);
      model.add_node(node);
    }
    return model;
  };
  const auto run = [&](const std::function<void()>& ready) {
    const Model model = sample_model();
    State state;
    state.nodes.resize(static_cast<std::size_t>(nodes) + 1);
    for (NodeState& node : state.nodes) node.R.setIdentity();
    const std::vector<Slots> slots;
    ResultsFile results(path, model, "the text of the model", layout);
    results.begin_analysis("dynamic");
    ready();
    results.record(state, slots, model.environment, {});
    results.file();
  };
  const std::chrono::microseconds whole = time_between_bytes([&](int pipe) {
    run([&] { tell(pipe); });
    tell(pipe);
  });
  for (int trial = 0; trial < trials; ++trial) {
    CAPTURE(trial);
    run_and_kill(whole * trial / (trials - 2), [&](int pipe) {
      run([&] { tell(pipe); });
      std::this_thread::sleep_for(1h);
    });
    const Hdf5File file = Hdf5File::open(path);
    CHECK(file.read_integer_attribute("/", "complete") == 0);
    CHECK(file.read_text("/input") == "the text of the model");
    if (file.has("/time")) CHECK(file.shape("/time") == Shape{1});
  }
}

}  // namespace

TEST_CASE("A killed run leaves a readable file with whole rows, whenever it is killed") {
  kill_while_recording(GENERATE(ResultsLayout::named, ResultsLayout::stacked), 8);
}

TEST_CASE("A killed run leaves a readable file with whole rows at more moments", "[long]") {
  kill_while_recording(GENERATE(ResultsLayout::named, ResultsLayout::stacked), 24);
}

TEST_CASE("A run that is killed while it makes its datasets leaves a readable file") {
  kill_while_datasets_are_made(ResultsLayout::named, 500, 6);
  kill_while_datasets_are_made(ResultsLayout::stacked, 10'000, 6);
}

TEST_CASE("A run that is killed at more moments while it makes its datasets leaves a readable file", "[long]") {
  kill_while_datasets_are_made(ResultsLayout::named, 500, 12);
  kill_while_datasets_are_made(ResultsLayout::stacked, 10'000, 12);
}

TEST_CASE("Steps that were completed are in the file while a slow one runs") {
  const TemporaryFolder folder;
  run_and_kill(600ms, [&](int pipe) {
    ResultsSample sample;
    ResultsFile results(folder / "run.h5", sample.model, "");
    results.begin_analysis("dynamic");
    for (int i = 0; i < 5; ++i) sample.record(results, i);
    tell(pipe);
    std::this_thread::sleep_for(1h);  // the sixth step
  });
  CHECK(check_rows(folder / "run.h5") == 5);
}

TEST_CASE("An earlier analysis survives a kill in a later one") {
  const TemporaryFolder folder;
  run_and_kill(300ms, [&](int pipe) {
    ResultsSample sample;
    ResultsFile results(folder / "run.h5", sample.model, "");
    results.begin_analysis("static");
    for (int i = 0; i < 3; ++i) sample.record(results, i);
    results.end_analysis();
    constexpr int rows = 50'000;  // known, so that the file does not grow in the moment of the kill
    results.begin_analysis("dynamic", rows);
    tell(pipe);
    for (int i = 0; i < rows; ++i) sample.record(results, i);
    std::this_thread::sleep_for(1h);
  });
  const Hdf5File file = Hdf5File::open(folder / "run.h5");
  CHECK(file.shape("/analysis_1/time").at(0) == 3);
  CHECK(check_rows(folder / "run.h5") > 3);
}
