#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/packing.hpp"
#include "reduce/common/process/child_process.hpp"
#include "reduce/common/process/closed_process.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using bielle::test::message_of;

namespace {

std::string ended_by(void (*end)(), const ChildLimits& limits = {}) {
  return message_of<InputError>([&] {
    in_child_process("a.msh: lost", limits, [&] {
      end();
      return std::string("not lost");
    });
  });
}

/// Returns the subject and the message of the failure of `work` in a child process.
template <class Error>
std::pair<std::string, std::string> failure(const ChildLoss& lost, const std::function<std::string()>& work) {
  try {
    in_child_process(lost, {}, work);
  } catch (const Error& error) {
    return {error.subject(), error.what()};
  }
  return {};
}

struct Part {
  int number = 0;
  std::map<std::string, std::vector<double>> lists;
  Eigen::Matrix3Xd points;
};

void exchange(Packing& packing, Part& part) {
  packing(part.number);
  packing(part.lists);
  packing(part.points);
}

}  // namespace

TEST_CASE("child process: results and exceptions of the work arrive", "[common]") {
  const std::string long_text(3'000'000, 'x');
  CHECK(in_child_process("lost", {}, [&] { return long_text; }) == long_text);
  CHECK(in_child_process("lost", {}, [] { return std::string(); }).empty());
  CHECK(message_of<InputError>([] {
          in_child_process("lost", {}, []() -> std::string { throw InputError("a.yaml:3: wrong"); });
        }) == "a.yaml:3: wrong");
  CHECK(message_of<ComputationError>([] {
          in_child_process("lost", {}, []() -> std::string { throw ComputationError("failed"); });
        }) == "failed");
  CHECK_THROWS_AS(in_child_process("lost", {}, []() -> std::string { throw std::bad_alloc(); }), std::bad_alloc);
}

TEST_CASE("child process: failures keep their subjects", "[common]") {
  using Told = std::pair<std::string, std::string>;
  ChildLoss loss("lost");
  loss.subject = "geometry";
  CHECK(failure<InputError>(loss, []() -> std::string { throw InputError("mesh", "wrong"); }) ==
        Told("mesh", "mesh: wrong"));
  CHECK(failure<InputError>(loss, []() -> std::string { throw InputError("mesh", "wrong", Subject::hidden); }) ==
        Told("mesh", "wrong"));
  CHECK(failure<InputError>(loss, []() -> std::string { throw InputError("wrong"); }) == Told("", "wrong"));
  CHECK(failure<ComputationError>(loss, []() -> std::string { throw ComputationError("mesh", "failed"); }) ==
        Told("mesh", "mesh: failed"));
  CHECK(failure<InputError>(loss, []() -> std::string { std::abort(); }) == Told("geometry", "geometry: lost"));
}

TEST_CASE("child process: every kind of crash gives a message", "[common]") {
  CHECK(ended_by([] { std::raise(SIGKILL); }) == "a.msh: lost");
  CHECK(ended_by([] { std::abort(); }) == "a.msh: lost");
  CHECK(ended_by([] { _exit(0); }) == "a.msh: lost");
}

TEST_CASE("child process: one that must not start other programs is ended if it tries, with a message", "[common]") {
  ChildLoss loss("crashed");
  loss.ended = "ended";
  loss.forbidden = "forbidden";
  const auto end_of = [&](void (*work)()) {
    return message_of<InputError>([&] {
      in_child_process(loss, {}, [&] {
        if (!forbid_other_programs()) return std::string();
        work();
        return std::string();
      });
    });
  };
  const bool able =
      in_child_process("lost", {}, [] { return std::string(forbid_other_programs() ? "able" : ""); }) == "able";
  if (!able) {
    WARN("this system has no seccomp");
    return;
  }
  CHECK(end_of([] { static_cast<void>(!std::system("true")); }) == "forbidden");
  CHECK(end_of([] { static_cast<void>(!popen("true", "r")); }) == "forbidden");
  CHECK(end_of([] { static_cast<void>(fork()); }) == "forbidden");
  CHECK(end_of([] { execl("/bin/true", "true", nullptr); }) == "forbidden");
  CHECK(end_of([] {
          std::signal(SIGSEGV, SIG_DFL);  // removes the handlers of test programs and sanitizers
          std::raise(SIGSEGV);
        }) == "crashed");
  CHECK(end_of([] { _exit(0); }) == "ended");
  // Threads, files and memory of the parent must have no influence.
  CHECK(in_child_process("lost", {}, [] {
          forbid_other_programs();
          std::string text;
          std::thread([&] { text = "from a thread"; }).join();
          return text;
        }) == "from a thread");
}

TEST_CASE("child process: work that does not end is killed", "[common]") {
  const auto endless = [] {
    for (volatile bool more = true; more;) {
    }
  };
  CHECK(ended_by(endless, {.seconds = 1}) == "a.msh: lost");
}

#ifndef __SANITIZE_ADDRESS__  // its operator new aborts if memory is refused
TEST_CASE("child process: an allocation beyond its limit of memory fails", "[common]") {
  const auto allocate = [](std::uint64_t limit) {
    return in_child_process("lost", {.memory = limit},
                            [] { return std::string(std::vector<char>(500'000'000).size() > 0 ? "there" : ""); });
  };
  CHECK(allocate(1'000'000'000) == "there");
  CHECK_THROWS_AS(allocate(300'000'000), std::bad_alloc);
}
#endif

TEST_CASE("packing: values are unpacked as they were packed", "[common]") {
  Part part{7, {{"a", {1, 2.5}}, {"", {}}}, Eigen::Matrix3Xd::Random(3, 5)}, found;
  Packing packing;
  packing(part);
  Packing back(packing.bytes());
  back(found);
  CHECK(found.number == 7);
  CHECK(found.lists == part.lists);
  CHECK(found.points == part.points);
  CHECK_THROWS_AS(back(found), std::logic_error);  // nothing is left
}
