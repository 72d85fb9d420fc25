// Work that threads share: each piece is done once; exceptions; concurrent callers.
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "mechanism/math/workers.hpp"

using bielle::mechanism::Workers;

TEST_CASE("each piece of work is done once, however many threads there are") {
  const int threads = GENERATE(1, 2, 7);
  Workers workers(threads);
  CHECK(workers.threads() == threads);
  for (const std::size_t count : {0u, 1u, 3u, 1000u})
    for (int round = 0; round < 50; ++round) {
      std::vector<std::atomic<int>> done(count);
      bool meanwhile = false;
      workers.for_each(
          count, [&](std::size_t k) { ++done[k]; }, [&] { meanwhile = true; });
      int wrong = 0;
      for (const auto& times : done) wrong += times != 1;
      REQUIRE(wrong == 0);
      REQUIRE(meanwhile);
    }
}

TEST_CASE("pieces are done by others while the caller does something else") {
  Workers workers(2);
  std::atomic<bool> done = false;
  const auto caller = std::this_thread::get_id();
  std::thread::id by;
  const auto piece = [&](std::size_t) {
    by = std::this_thread::get_id();
    done = true;
  };
  workers.for_each(1, piece, [&] {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!done && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  });
  CHECK(done);
  CHECK(by != caller);
}

TEST_CASE("what the caller throws meanwhile ends the work and leaves the team ready") {
  Workers workers(3);
  for (int round = 0; round < 20; ++round) {
    std::atomic<int> under_way = 0;
    const auto piece = [&](std::size_t) {
      ++under_way;
      std::this_thread::yield();
      --under_way;
    };
    CHECK_THROWS_AS(workers.for_each(100, piece, [] { throw std::runtime_error("no"); }), std::runtime_error);
    CHECK(under_way == 0);
  }
  std::atomic<int> sum = 0;
  workers.for_each(10, [&](std::size_t k) { sum += static_cast<int>(k); });
  CHECK(sum == 45);
}

TEST_CASE("callers that meet at a team all get their work done") {
  Workers workers(2);
  std::atomic<int> sum = 0;
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 4; ++caller)
    callers.emplace_back([&] {
      for (int round = 0; round < 200; ++round) workers.for_each(5, [&](std::size_t) { ++sum; });
    });
  for (std::thread& caller : callers) caller.join();
  CHECK(sum == 4 * 200 * 5);
  // A piece that calls the team itself.
  workers.for_each(3, [&](std::size_t) { workers.for_each(3, [&](std::size_t) { ++sum; }); });
  CHECK(sum == 4 * 200 * 5 + 9);
}
