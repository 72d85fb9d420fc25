#include "results_sample.hpp"
#include <catch2/catch.hpp>

#include "mechanism/results/largest_values.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::ResultsSample;
using bielle::test::TemporaryFolder;
using Catch::Matchers::Contains;

TEST_CASE("The largest values of an analysis are found in its rows, in both layouts") {
  // The sample records 1010 + t, 1020 + t, 1030 + t as the reaction's force and 1040 + t .. as its moment.
  for (const ResultsLayout layout : {ResultsLayout::named, ResultsLayout::stacked}) {
    const TemporaryFolder folder;
    ResultsSample sample;
    ResultsFile results(folder / "run.h5", sample.model, "", layout);
    CHECK(results.largest_values().empty());
    results.begin_analysis("dynamic");
    for (const int step : {0, 4, 2}) sample.record(results, step);
    results.end_analysis();
    CHECK(results.largest_values() ==
          "  largest values of the recorded rows\n"
          "    reaction force 1770 N, joint 'main', t = 2 s\n"     // |(1012, 1022, 1032)| = 1770.2
          "    reaction moment 1822 N m, joint 'main', t = 2 s\n"  // |(1042, 1052, 1062)| = 1822.2
          "    torque of a drive 4002 N m, joint 'main', t = 2 s\n");
    results.begin_analysis("static");
    sample.record(results, 1);
    results.end_analysis();
    CHECK_THAT(results.largest_values(), Contains("joint 'main', load factor = 0.5\n"));
  }
}

TEST_CASE("Only rows that the analysis recorded count, and zeros are not mentioned") {
  ResultsSample sample;
  LargestValues largest(ResultsKinds(sample.model, false));
  const std::vector<double> zeros(ResultsRows(sample.model).size(), 0.0);
  largest.begin("the recorded rows", "t", " s");
  largest.add(0, zeros.data());
  CHECK(largest.summary().empty());
}
