#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "results_sample.hpp"
#include <catch2/catch.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mechanism/math/so3.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::ResultsSample;
using bielle::test::TemporaryFolder;
using Catch::Matchers::Contains;
using Values = std::vector<double>;

namespace {

/// Writes a finished file of one analysis with the given number of rows.
std::string finished(const TemporaryFolder& folder, int rows) {
  ResultsSample sample;
  ResultsFile results(folder / "run.h5", sample.model, "mechanism: a sample\n");
  results.begin_analysis("dynamic");
  for (int i = 0; i < rows; ++i) sample.record(results, i);
  results.end_analysis();
  results.complete();
  return folder / "run.h5";
}

std::size_t rows_in(const Hdf5File& file, const std::string& dataset) { return file.shape(dataset).at(0); }

}  // namespace

TEST_CASE("A results file says what it is") {
  const TemporaryFolder folder;
  const Hdf5File file = Hdf5File::open(finished(folder, 2));
  CHECK(file.read_text_attribute("/", "format") == "bielle results");
  CHECK(file.read_integer_attribute("/", "version") == 1);
  CHECK(file.read_text_attribute("/", "name") == "a sample");
  CHECK_THAT(file.read_text_attribute("/", "created_by"), Contains("bielle-mechanism"));
  CHECK(file.read_integer_attribute("/", "complete") == 1);
  CHECK(file.read_text("/input") == "mechanism: a sample\n");
  CHECK(file.read_text_attribute("/analysis_1", "type") == "dynamic");
}

TEST_CASE("Nodes are recorded with position, quaternion and rates; internal ones and ground are not") {
  const TemporaryFolder folder;
  const Hdf5File file = Hdf5File::open(finished(folder, 3));
  CHECK(file.names_in("/nodes") == std::vector<std::string>{"pin", "tip"});
  CHECK(file.read("/time") == Values{0, 0.5, 1});
  CHECK(file.read("/nodes/tip/position") == Values{3, 0, 0, 3, 1, 0, 3, 2, 0});
  CHECK(file.shape("/nodes/tip/rotation") == Shape{3, 4});
  CHECK(file.read("/nodes/tip/rotation")[0] == 1);
  const Values velocity = file.read("/nodes/pin/velocity"), acceleration = file.read("/nodes/pin/acceleration");
  CHECK(Values(velocity.begin() + 6, velocity.begin() + 12) == Values{1, 2, 3, 4, 5, 6});
  CHECK(Values(acceleration.begin() + 12, acceleration.end()) == Values{7, 8, 9, 10, 11, 12});
  CHECK(file.units("/nodes/pin/velocity") == "m/s, rad/s");
  CHECK(file.read_text_attribute("/nodes/tip", "carrier") == "pin");
  CHECK_FALSE(file.has_attribute("/nodes/pin", "carrier"));
}

TEST_CASE("Components record their fields; several in a group share it, stacked ones form an array") {
  const TemporaryFolder folder;
  const Hdf5File file = Hdf5File::open(finished(folder, 2));
  CHECK(file.names_in("/joints/main") == std::vector<std::string>{"coordinate", "reaction", "drive_force"});
  CHECK(file.read("/joints/main/coordinate") == Values{1000, 1000.5});
  CHECK(file.shape("/joints/main/coordinate") == Shape{2, 1});
  CHECK(file.read("/joints/main/reaction")[6] == 1010.5);
  CHECK(file.read("/joints/main/drive_force") == Values{4000, 4000.5});
  CHECK(file.units("/joints/main/coordinate") == "rad");
  CHECK(file.read_text_attribute("/joints/main/coordinate", "description") == "of the hinge");
  CHECK(file.read_text_attribute("/joints/main", "type") == "hinge");
  CHECK(file.read_text_attribute("/joints/main", "id") == "1");

  CHECK(file.shape("/elements/shaft/strain") == Shape{2, 2, 6});
  CHECK(file.shape("/elements/shaft/energy") == Shape{2, 2});
  const Values strain = file.read("/elements/shaft/strain");
  CHECK(strain[0 * 12 + 0 * 6 + 5] == 2050);
  CHECK(strain[1 * 12 + 1 * 6 + 2] == 3020.5);
  CHECK(file.read("/elements/shaft/energy") == Values{2060, 3060, 2060.5, 3060.5});
  CHECK(file.read_text_attribute("/elements/shaft", "type") == "beam");
  CHECK_FALSE(file.has("/loads"));
}

TEST_CASE("A chain records the positions and rotations of its nodes, internal ones included") {
  const TemporaryFolder folder;
  const Hdf5File file = Hdf5File::open(finished(folder, 2));
  CHECK(file.shape("/elements/shaft/position") == Shape{2, 3, 3});
  CHECK(file.read("/elements/shaft/position") == Values{1, 0, 0, 2, 0, 0, 3, 0, 0, 1, 1, 0, 2, 1, 0, 3, 1, 0});
  CHECK(file.shape("/elements/shaft/rotation") == Shape{2, 3, 4});
}

TEST_CASE("Energies and the work of the solver are recorded") {
  const TemporaryFolder folder;
  const Hdf5File file = Hdf5File::open(finished(folder, 2));
  CHECK(file.read("/energy/kinetic")[1] == 1);
  CHECK(file.read("/energy/elastic")[1] == 2);
  CHECK(file.read("/energy/gravity")[1] == 3);
  CHECK(file.read("/energy/dissipated")[1] == 4);
  CHECK(file.read("/energy/input")[1] == 5);
  CHECK(file.read("/energy/balance")[1] == 6);
  CHECK(file.units("/energy/balance") == "J");
  CHECK(file.read("/solver/step")[1] == 0.5);
  CHECK(file.read("/solver/newton_iterations")[1] == 3);
  CHECK(file.read("/solver/error_estimate")[1] == 0.25);
}

TEST_CASE("Rows beyond one block arrive in order") {
  const TemporaryFolder folder;
  const int rows = 3000;
  const Hdf5File file = Hdf5File::open(finished(folder, rows));
  const Values time = file.read("/time"), position = file.read("/nodes/pin/position");
  REQUIRE(time.size() == rows);
  REQUIRE(position.size() == 3 * rows);
  for (std::size_t i = 0; i < rows; ++i) REQUIRE((time[i] == 0.5 * static_cast<double>(i) && position[3 * i + 1] == i));
}

TEST_CASE("Quaternions continue from row to row through full turns") {
  const TemporaryFolder folder;
  ResultsSample sample;
  {
    ResultsFile results(folder / "run.h5", sample.model, "");
    results.begin_analysis("dynamic");
    for (int i = 0; i < 100; ++i) {
      sample.state.nodes[1].R = exp_so3({0, 0, 0.2 * i});
      sample.record(results, i);
    }
    results.end_analysis();
  }
  const Values q = Hdf5File::open(folder / "run.h5").read("/nodes/pin/rotation");
  for (std::size_t i = 0; i < 100; ++i) {
    // About z by 0.2 i: (cos, 0, 0, sin) of 0.1 i, a sign that continues included.
    CHECK_THAT(q[4 * i], Catch::Matchers::WithinAbs(std::cos(0.1 * static_cast<double>(i)), 1e-14));
    CHECK_THAT(q[4 * i + 3], Catch::Matchers::WithinAbs(std::sin(0.1 * static_cast<double>(i)), 1e-14));
  }
}

TEST_CASE("Each analysis has its group; the root links to the last that has the thing") {
  const TemporaryFolder folder;
  ResultsSample sample;
  ResultsFile results(folder / "run.h5", sample.model, "");
  results.begin_analysis("static");
  sample.record(results, 1);
  results.end_analysis();
  results.begin_analysis("dynamic");
  sample.record(results, 2);
  sample.record(results, 3);
  results.end_analysis();
  results.begin_analysis("eigen");
  results.file().write(results.analysis_group() + "/eigen/frequency", Eigen::VectorXd(Eigen::Vector2d(5, 6)), "Hz");
  results.end_analysis();
  results.complete();
  const Hdf5File file = Hdf5File::open(folder / "run.h5");
  CHECK(file.read("/analysis_1/time") == Values{0.5});
  CHECK(file.read("/analysis_2/time") == Values{1, 1.5});
  CHECK(file.read("/time") == Values{1, 1.5});
  CHECK(rows_in(file, "/nodes/pin/position") == 2);
  CHECK(file.read("/eigen/frequency") == Values{5, 6});
  CHECK(file.names_in("/analysis_3") == std::vector<std::string>{"eigen"});
  CHECK(file.read_text_attribute("/analysis_3", "type") == "eigen");
}

TEST_CASE("Before an analysis has rows, the root shows the one before") {
  const TemporaryFolder folder;
  ResultsSample sample;
  {
    ResultsFile results(folder / "run.h5", sample.model, "");
    results.begin_analysis("static");
    sample.record(results, 1);
    results.end_analysis();
    results.begin_analysis("dynamic");
  }  // the run fails here
  const Hdf5File file = Hdf5File::open(folder / "run.h5");
  CHECK(file.read("/time") == Values{0.5});
  CHECK(file.read_integer_attribute("/", "complete") == 0);
}

TEST_CASE("A run that ends early leaves all its rows, marked incomplete") {
  const TemporaryFolder folder;
  ResultsSample sample;
  try {
    ResultsFile results(folder / "run.h5", sample.model, "");
    results.begin_analysis("dynamic");
    for (int i = 0; i < 7; ++i) sample.record(results, i);
    throw ComputationError("Newton did not converge");
  } catch (const ComputationError&) {
  }
  const Hdf5File file = Hdf5File::open(folder / "run.h5");
  CHECK(file.read_integer_attribute("/", "complete") == 0);
  CHECK(rows_in(file, "/time") == 7);
  CHECK(rows_in(file, "/nodes/pin/position") == 7);
}

TEST_CASE("The events of a run that fails are found at the root") {
  const TemporaryFolder folder;
  {
    ResultsSample sample;
    ResultsFile results(folder / "run.h5", sample.model, "");
    results.begin_analysis("dynamic");
    sample.record(results, 0);
    results.note({0.125, 3, "an event"});
    results.note({0.25, 1, "another"});
  }  // the run fails here
  const Hdf5File file = Hdf5File::open(folder / "run.h5");
  CHECK(file.read("/events/time") == Values{0.125, 0.25});
  CHECK(file.read("/events/crossing") == Values{3, 1});
}

TEST_CASE("Mistakes of the program are told") {
  const TemporaryFolder folder;
  ResultsSample sample;
  {
    ResultsFile results(folder / "run.h5", sample.model, "");
    CHECK_THROWS_AS(sample.record(results, 0), std::logic_error);
  }
  using test::NumberedComponent;
  sample.model.add(
      std::make_unique<NumberedComponent>("beam", "x", 9, std::vector<OutputField>{{"other", {}, "-", ""}}),
      Entry{Section::elements, "shaft"}, Recorded::stacked);
  CHECK_THROWS_WITH(ResultsFile(folder / "run.h5", sample.model, ""),
                    Contains("'elements/shaft' record different results"));
  ResultsSample again;
  again.model.add(std::make_unique<NumberedComponent>("x", "x", 9, std::vector<OutputField>{{"reaction", {}, "-", ""}}),
                  Entry{Section::joints, "main"});
  CHECK_THROWS_WITH(ResultsFile(folder / "run.h5", again.model, ""), Contains("'joints/main/reaction'"));
  CHECK_THROWS_AS(ResultsFile(folder / "no/folder/run.h5", sample.model, ""), std::exception);
}

TEST_CASE("A full disk ends the run as a failed computation") {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{2'000'000, 2'000'000};
    setrlimit(RLIMIT_FSIZE, &small);
    if (std::freopen((folder / "log").c_str(), "w", stderr) == nullptr) _exit(1);
    ResultsSample sample;
    const std::string message = test::message_of<ComputationError>([&] {
      ResultsFile results(folder / "run.h5", sample.model, "");
      results.begin_analysis("dynamic");
      for (int i = 0; i < 100'000; ++i) sample.record(results, i);
    });
    _exit(message.find("is the disk full?") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(std::filesystem::file_size(folder / "log") == 0);  // HDF5 keeps its own account of it to itself
}
