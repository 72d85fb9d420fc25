// Tests that data written at one end of a channel arrive at the other, and that a closed end is noticed.
#include <array>
#include <csignal>
#include <string>

#include <catch2/catch.hpp>
#include <sys/socket.h>

#include "reduce/common/error.hpp"
#include "reduce/distributed/channel.hpp"
#include "reduce/distributed/shares.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

std::array<int, 2> connected() {
  std::array<int, 2> ends{};
  REQUIRE(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0);
  return ends;
}

}  // namespace

TEST_CASE("numbers, texts and outcomes pass a channel") {
  const auto ends = connected();
  Channel here(ends[0], "there"), there(ends[1], "here");
  here.send_number(0.1);
  here.send_text(std::string("zero\0inside", 11));
  here.send_text("");
  here.send_outcome({Outcome::failed, "why"});
  CHECK(there.receive_number<double>() == 0.1);
  CHECK(there.receive_text() == std::string("zero\0inside", 11));
  CHECK(there.receive_text().empty());
  const Outcome outcome = there.receive_outcome();
  CHECK(outcome.kind == Outcome::failed);
  CHECK(outcome.message == "why");
}

TEST_CASE("parts of a mesh are unpacked as they were packed") {
  InteriorShare share{{3, -1, 4}, {0, 0, 2, 2}, {7, 8}, {0.5, -2}};
  Packing packing;
  packing(share);
  InteriorShare copy;
  Packing(packing.bytes())(copy);
  CHECK(copy.numbers == share.numbers);
  CHECK(copy.starts == share.starts);
  CHECK(copy.unknowns == share.unknowns);
  CHECK(copy.weights == share.weights);
}

TEST_CASE("a closed channel and an incomplete message are told apart") {
  std::signal(SIGPIPE, SIG_IGN);
  const auto ends = connected();
  Channel here(ends[0], "the ranks");
  double number = 0;
  {
    Channel there(ends[1], "here");
    there.send("abc", 3);
  }
  CHECK_THROWS_AS(here.receive_if_any(&number, sizeof number), ComputationError);
  CHECK_FALSE(here.receive_if_any(&number, sizeof number));
  CHECK_THROWS_WITH(here.receive(&number, sizeof number), "the connection to the ranks is broken");
  CHECK_THROWS_AS(here.send_number(1), ComputationError);
}
