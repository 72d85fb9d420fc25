#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "reduce/common/files/atomic_output.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::AtomicOutput;
using bielle::ComputationError;
using bielle::Hdf5File;
using bielle::InputError;
using bielle::Shape;
using bielle::test::message_of;
using bielle::test::TemporaryFolder;
using Catch::Matchers::Contains;

namespace {

template <class Action>
std::string why_unreadable(Action&& action) {
  return message_of<InputError>(action);
}

/// Runs `action` in a child process and returns its status from waitpid.
template <class Action>
int status_of_child(Action&& action) {
  const pid_t child = fork();
  if (child == 0) {
    action();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("Datasets are read as they were written, with units and shape") {
  const TemporaryFolder folder;
  Eigen::MatrixXd matrix(2, 3);
  matrix << 1, 2, 3, 4, 5, 6;
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("/reduced/stiffness", matrix, "N/m", "K~");
    file.write("/vector", Eigen::VectorXd(Eigen::Vector2d(7, 8)), "m");
    file.write("/number", 2.5, "kg");
    file.write("/empty", Eigen::MatrixXd(0, 4), "m");
    file.write("/integers", std::vector<std::int64_t>{1, -2, 1LL << 40}, {3}, "-");
    file.write("/cube", std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8}, {2, 2, 2}, "Pa");
    file.write_text("/input", "größer\n");
    file.write_names("/names", {"big_end", "", "Ø"});
    file.write_names("/no_names", {});
    file.write_attribute("/", "format", std::string("a format"));
    file.write_attribute("/reduced", "version", std::int64_t{3});
    file.close();
  }
  const Hdf5File file = Hdf5File::open(folder / "a.h5");
  CHECK(file.path() == folder / "a.h5");
  CHECK(file.read_matrix("/reduced/stiffness") == matrix);
  CHECK(file.read("/reduced/stiffness") == std::vector<double>{1, 2, 3, 4, 5, 6});  // row by row in the file
  CHECK(file.shape("/reduced/stiffness") == Shape{2, 3});
  CHECK(file.units("/reduced/stiffness") == "N/m");
  CHECK(file.read_text_attribute("/reduced/stiffness", "description") == "K~");
  CHECK_FALSE(file.has_attribute("/vector", "description"));
  CHECK(file.read_vector("/vector") == Eigen::VectorXd(Eigen::Vector2d(7, 8)));
  CHECK(file.read_number("/number") == 2.5);
  CHECK(file.shape("/number").empty());
  CHECK(file.read_matrix("/empty").cols() == 4);
  CHECK(file.read_integers("/integers") == std::vector<std::int64_t>{1, -2, 1LL << 40});
  CHECK(file.read("/integers")[1] == -2);
  CHECK(file.shape("/cube") == Shape{2, 2, 2});
  CHECK(file.read_text("/input") == "größer\n");
  CHECK(file.read_names("/names") == std::vector<std::string>{"big_end", "", "Ø"});
  CHECK(file.read_names("/no_names").empty());
  CHECK(file.read_text_attribute("/", "format") == "a format");
  CHECK(file.read_integer_attribute("/reduced", "version") == 3);
  CHECK(file.has("/reduced"));
  CHECK(file.has("/"));
  CHECK_FALSE(file.has("/reduced/mass"));
  CHECK_FALSE(file.has("/nothing/there"));
}

TEST_CASE("Members of a group are listed in the order in which they were made") {
  const TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  for (const char* name : {"z", "a", "m", "k", "b", "y", "c", "x", "d", "w"})
    file.write("/nodes/" + std::string(name), 1, "-");
  file.write_text("/input", "");
  CHECK(file.names_in("/nodes") == std::vector<std::string>{"z", "a", "m", "k", "b", "y", "c", "x", "d", "w"});
  CHECK(file.names_in("/") == std::vector<std::string>{"nodes", "input"});
  CHECK_THROWS_AS(file.names_in("/none"), ComputationError);
}

TEST_CASE("A dataset without units, or with a shape that does not fit, is refused") {
  const TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  CHECK_THROWS_AS(file.write("/a", 1.0, ""), std::logic_error);
  CHECK_THROWS_AS(file.create_rows("/b", {3}, ""), std::logic_error);
  CHECK_THROWS_AS(file.write("/c", std::vector<double>{1, 2}, {3}, "m"), std::logic_error);
  file.write("/d", 1.0, "m");
  CHECK_THAT(message_of<ComputationError>([&] { file.write("/d", 1.0, "m"); }), Contains("/d: cannot be made"));
}

TEST_CASE("A matrix larger than one block keeps its rows and columns") {
  const TemporaryFolder folder;
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(1001, 1003);
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  file.write("/large", matrix, "-");
  CHECK(file.read_matrix("/large") == matrix);
  CHECK(file.read("/large")[1003 * 700 + 2] == matrix(700, 2));
}

TEST_CASE("Text may be longer than the 64 kB that HDF5 allows for attributes") {
  const TemporaryFolder folder;
  const std::string text(200'000, 'x');
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  file.write_text("/input", text);
  file.write_attribute("/", "note", text);
  file.close();
  CHECK(Hdf5File::open(folder / "a.h5").read_text("/input") == text);
  CHECK(Hdf5File::open(folder / "a.h5").read_text_attribute("/", "note") == text);
}

TEST_CASE("Rows are appended by the writer, and to a file that is opened again") {
  const TemporaryFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.create_rows("/position", {3}, "m", "", 2);
    file.create_rows("/time", {}, "s");
    file.create_rows("/nothing", {0}, "m");
    file.append_rows("/position", std::vector<double>{1, 2, 3});
    file.append_rows("/position", std::vector<double>{4, 5, 6, 7, 8, 9}, 2);
    file.append_rows("/position", {}, 0);
    file.append_rows("/nothing", {}, 3);
    file.append_rows("/time", std::vector<double>{0, 1, 2}, 3);
    CHECK_THROWS_AS(file.append_rows("/position", std::vector<double>{1, 2}), std::logic_error);
  }
  Hdf5File file = Hdf5File::open_to_extend(folder / "a.h5");
  file.append_rows("/position", std::vector<double>{10, 11, 12});
  CHECK(file.shape("/position") == Shape{4, 3});
  CHECK(file.read("/position") == std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  CHECK(file.shape("/nothing") == Shape{3, 0});
  CHECK(file.units("/time") == "s");
}

TEST_CASE("Attributes can be changed and links moved") {
  const TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  file.write_attribute("/", "complete", std::int64_t{0});
  file.write_attribute("/", "complete", std::int64_t{1});
  file.write_attribute("/", "name", std::string("a"));
  file.write_attribute("/", "name", std::string("longer"));
  CHECK(file.read_integer_attribute("/", "complete") == 1);
  CHECK(file.read_text_attribute("/", "name") == "longer");
  file.write("/analysis_1/time", 1.0, "s");
  file.write("/analysis_2/time", 2.0, "s");
  file.link("/analysis_1/time", "/time");
  CHECK(file.read_number("/time") == 1);
  file.link("/analysis_2/time", "/time");
  CHECK(file.read_number("/time") == 2);
  file.link("/analysis_3/time", "/dangling");
  CHECK_FALSE(file.has("/dangling"));
}

TEST_CASE("The message about a file that cannot be read tells the reason") {
  const TemporaryFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "whole.h5");
    file.write("/data", std::vector<double>(10'000, 1.0), {10'000}, "m");
    file.write_text("/text", "abc");
    file.write("/cube", std::vector<double>(8, 1.0), {2, 2, 2}, "m");
  }
  const std::string whole = bytes_of(folder / "whole.h5");
  CHECK_THAT(why_unreadable([&] { Hdf5File::open(folder / "none.h5"); }), Contains("none.h5: there is no such file"));
  CHECK_THAT(why_unreadable([&] { Hdf5File::open(folder.path()); }), Contains("is a folder"));
  CHECK_THAT(why_unreadable([&] { Hdf5File::open(folder.file("text.h5", "hello\n")); }), Contains("is no HDF5 file"));
  CHECK_THAT(why_unreadable([&] { Hdf5File::open(folder.file("empty.h5", "")); }), Contains("is no HDF5 file"));
  CHECK_THAT(why_unreadable([&] { Hdf5File::open(folder.file("cut.h5", whole.substr(0, whole.size() / 2))); }),
             Contains("cut.h5: cannot be opened: truncated, damaged"));
  CHECK_THAT(why_unreadable([&] { Hdf5File::open_to_extend(folder / "none.h5"); }), Contains("there is no such file"));
  const Hdf5File file = Hdf5File::open(folder / "whole.h5");
  CHECK_THAT(why_unreadable([&] { file.read("/none"); }), Contains("whole.h5: /none: is not in this file"));
  CHECK_THAT(why_unreadable([&] { file.read("/"); }), Contains("is no dataset"));
  CHECK_THAT(why_unreadable([&] { file.read("/text"); }), Contains("/text: expected numbers"));
  CHECK_THAT(why_unreadable([&] { file.read_text("/data"); }), Contains("/data: expected text"));
  CHECK_THAT(why_unreadable([&] { file.read_integers("/data"); }), Contains("/data: expected integers"));
  CHECK_THAT(why_unreadable([&] { file.read_matrix("/data"); }),
             Contains("expected a matrix, found the shape (10000)"));
  CHECK_THAT(why_unreadable([&] { file.read_vector("/cube"); }), Contains("found the shape (2, 2, 2)"));
  CHECK_THAT(why_unreadable([&] { file.read_number("/data"); }), Contains("expected one number, found 10000"));
  CHECK_THAT(why_unreadable([&] { file.read_text_attribute("/", "none"); }), Contains("has no attribute 'none'"));
  CHECK_THAT(why_unreadable([&] { file.read_integer_attribute("/data", "units"); }), Contains("is no whole number"));
  CHECK_THAT(message_of<ComputationError>([&] { Hdf5File::create(folder / "no/folder/a.h5"); }),
             Contains("cannot be created"));
}

TEST_CASE("Damaged lengths of texts are noticed before memory is allocated for them") {
  const TemporaryFolder folder;
  Hdf5File::create(folder / "whole.h5").write_text("/text", "abc");
  std::string bytes = bytes_of(folder / "whole.h5");
  // A text is stored as its length (4 bytes) and the address of the heap (8 bytes) that holds it.
  const std::uint64_t heap = bytes.find("GCOL");
  REQUIRE(heap != std::string::npos);
  const std::size_t address = bytes.find(std::string(reinterpret_cast<const char*>(&heap), sizeof heap));
  REQUIRE(address != std::string::npos);
  bytes.replace(address - 4, 4, "\xff\xff\xff\xf0");
  CHECK_THAT(why_unreadable([&] { Hdf5File::open(folder.file("long.h5", bytes)); }),
             Contains("long.h5: is damaged: a text at /text cannot be read"));
}

TEST_CASE("Chunks of rows that are too short are noticed before HDF5 reads beyond them") {
  const TemporaryFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "whole.h5");
    file.create_rows("/position", {6}, "m", "", 4);
    file.append_rows("/position", std::vector<double>(18, 1.5), 3);
  }
  CHECK(Hdf5File::open(folder / "whole.h5").shape("/position") == Shape{3, 6});
  std::string bytes = bytes_of(folder / "whole.h5");
  // A node of the tree of chunks (of type 1) has a head of 24 bytes, then the size of the first chunk (4 bytes).
  const std::size_t node = bytes.find(std::string("TREE\x01"));
  REQUIRE(node != std::string::npos);
  REQUIRE(bytes.substr(node + 24, 4) == std::string("\xc0\0\0\0", 4));
  bytes[node + 24] = '\x80';
  CHECK_THAT(why_unreadable([&] { Hdf5File::open(folder.file("short.h5", bytes)); }),
             Contains("short.h5: is damaged: the pieces of /position are not as large as they should be"));
}

TEST_CASE("The HDF5 library prints nothing") {
  const TemporaryFolder folder;
  const std::string log = folder / "log";
  const int status = status_of_child([&] {
    if (std::freopen(log.c_str(), "w", stderr) == nullptr) _exit(1);
    why_unreadable([&] { Hdf5File::open(folder.file("text.h5", "hello\n")); });
    message_of<ComputationError>([&] { Hdf5File::create(folder / "no/folder/a.h5"); });
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    message_of<ComputationError>([&] { file.read("/none"); });
    std::fflush(stderr);
  });
  CHECK(status == 0);
  CHECK(bytes_of(log).empty());
}

TEST_CASE("A file is written in the earliest format that can hold it") {
  const TemporaryFolder folder;
  Hdf5File::create(folder / "a.h5").write("/x", 1.0, "m");
  // The version of the superblock follows the signature of 8 bytes; version 1 contains the size of chunk indices.
  CHECK(bytes_of(folder / "a.h5").at(8) == 1);
}

TEST_CASE("After kill -9 a file holds all that was flushed") {
  const TemporaryFolder folder;
  const std::string path = folder / "killed.h5";
  const int status = status_of_child([&] {
    Hdf5File file = Hdf5File::create(path);
    file.create_rows("/position", {3}, "m", "", 16);
    for (int i = 0; i < 100; ++i) file.append_rows("/position", std::vector<double>{1.0 * i, 2.0 * i, 3.0 * i});
    file.flush();
    for (int i = 100; i < 110; ++i) file.append_rows("/position", std::vector<double>{1.0 * i, 2.0 * i, 3.0 * i});
    raise(SIGKILL);
  });
  REQUIRE(WIFSIGNALED(status));
  const Hdf5File file = Hdf5File::open(path);
  REQUIRE(file.shape("/position") == Shape{100, 3});
  const std::vector<double> values = file.read("/position");
  for (std::size_t i = 0; i < 100; ++i) REQUIRE(values[3 * i + 2] == 3.0 * static_cast<double>(i));
}

TEST_CASE("A full disk is a failed computation, not a crash") {
  const TemporaryFolder folder;
  const int status = status_of_child([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100'000, 100'000};
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string message = message_of<ComputationError>([&] {
      Hdf5File file = Hdf5File::create(folder / "big.h5");
      file.create_rows("/position", {1000}, "m");
      for (int i = 0; i < 100; ++i) file.append_rows("/position", std::vector<double>(1000, 1.0));
      file.close();
    });
    _exit(message.find("is the disk full?") != std::string::npos ? 0 : 1);
  });
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("An output file gets its name only when it is complete") {
  const TemporaryFolder folder;
  const std::string path = folder.file("body.h5", "earlier");
  {
    const AtomicOutput output(path);
    CHECK(output.temporary_path() == path + ".partial");
    std::ofstream(output.temporary_path()) << "half";
  }
  CHECK(bytes_of(path) == "earlier");
  CHECK_FALSE(std::filesystem::exists(path + ".partial"));
  {
    AtomicOutput output(path);
    std::ofstream(output.temporary_path()) << "whole";
    output.commit();
  }
  CHECK(bytes_of(path) == "whole");
  CHECK_FALSE(std::filesystem::exists(path + ".partial"));
  AtomicOutput never_written((std::filesystem::path(folder.path()) / "missing" / "none.h5").string());
  CHECK_THAT(message_of<ComputationError>([&] { never_written.commit(); }), Contains("cannot take its name"));
}
