#include <string>

#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/files/table_file.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using bielle::read_table;
using bielle::test::message_of;
using Catch::Matchers::Contains;

TEST_CASE("Tables are read with any separator of their numbers") {
  const bielle::test::TemporaryFolder folder;
  Eigen::MatrixXd expected(2, 2);
  expected << 0, 1.5, 2, -3e2;
  for (const std::string text : {"0,1.5\n2,-3e2\n", "0;1.5\r\n2;-3e2\r\n", "0\t1.5\n2\t-3e2", "  0   1.5\n 2 -3e2 \n",
                                 "time [s], angle\n0, 1.5\n+2, -3e2\n", "# made by hand\n\n0, 1.5 # start\n2, -3e2\n\n",
                                 "\"t\";\"x\"\n0;1.5\n2;-3e2\n", "\xEF\xBB\xBFt,x\n0,1.5\n2,-3e2\n"}) {
    INFO(text);
    CHECK(read_table(folder.file("table.csv", text), 2) == expected);
  }
}

TEST_CASE("The message about a wrong table tells the line") {
  const bielle::test::TemporaryFolder folder;
  const auto why = [&](const std::string& text) {
    return message_of<bielle::InputError>([&] { read_table(folder.file("table.csv", text), 2); });
  };
  CHECK_THAT(why("0,1\n2\n"), Contains("table.csv:2: expected 2 numbers, found 1"));
  CHECK_THAT(why("0,1\n2,3,4\n"), Contains("table.csv:2: expected 2 numbers, found 3"));
  CHECK_THAT(why("0,1\n2,x\n"), Contains("table.csv:2: expected a number, found 'x'"));
  CHECK_THAT(why("0,1\n2,\n"), Contains("table.csv:2: expected a number, found ''"));
  CHECK_THAT(why("0,1\n2,nan\n"), Contains("expected a number, found 'nan'"));
  CHECK_THAT(why("t,x\ns,m\n0,1\n"), Contains("table.csv:2: expected a number, found 's'"));
  CHECK_THAT(why("0;1,5\n"), Contains("expected 2 numbers, found 3"));
  CHECK_THAT(why(""), Contains("table.csv: holds no rows"));
  CHECK_THAT(why("t,x\n"), Contains("holds no rows"));
  CHECK_THAT(message_of<bielle::InputError>([&] { read_table(folder / "none.csv", 2); }), Contains("no such file"));
  CHECK_THAT(message_of<bielle::InputError>([&] { read_table(folder.path(), 2); }), Contains("folder"));
}
