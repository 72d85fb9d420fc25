// The search for near pairs against the comparison of all pairs.
#include <algorithm>
#include <limits>

#include <catch2/catch.hpp>

#include "mechanism/contacts/near_pairs.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::Random;

namespace {

struct Cloud {
  std::vector<NearPairs::Bound> bounds;
  std::vector<std::pair<int, int>> pairs;

  /// A plane and spheres of different sizes, spread most along an axis.
  Cloud(int spheres, Eigen::Index axis, Random& random) {
    bounds.push_back({Vector3::Zero(), std::numeric_limits<double>::infinity(), Vector3(0, 0, 1)});
    for (int k = 0; k < spheres; ++k) {
      Vector3 middle = random.vector3();
      middle[axis] *= 5;
      bounds.push_back({middle, random.uniform(0.05, 0.3), Vector3::Zero()});
    }
    for (int a = 0; a <= spheres; ++a)
      for (int b = a + 1; b <= spheres; ++b)
        if ((a + b) % 7 != 0) pairs.emplace_back(a, b);
  }
  double apart(int pair) const {
    const auto [a, b] = pairs[static_cast<std::size_t>(pair)];
    return NearPairs::apart(bounds[static_cast<std::size_t>(a)], bounds[static_cast<std::size_t>(b)]);
  }
};

}  // namespace

TEST_CASE("bounds are apart by the distance of their middles or from the plane, less their reaches") {
  const NearPairs::Bound one{{1, 2, 3}, 0.5, Vector3::Zero()}, other{{4, 6, 3}, 0.25, Vector3::Zero()},
      plane{{7, 8, 1}, std::numeric_limits<double>::infinity(), Vector3(0, 0, 1)};
  CHECK(NearPairs::apart(one, other) == Approx(5 - 0.75));
  CHECK(NearPairs::apart(one, plane) == Approx(2 - 0.5));
  CHECK(NearPairs::apart(plane, one) == Approx(2 - 0.5));
}

TEST_CASE("pairs whose bounds overlap are found, along whichever axis the shapes are spread") {
  Random random(5);
  for (const Eigen::Index axis : {0, 1, 2}) {
    const Cloud cloud(60, axis, random);
    const NearPairs near(61, cloud.pairs);
    std::vector<int> found, expected;
    near.find(cloud.bounds, found);
    for (int pair = 0; pair < static_cast<int>(cloud.pairs.size()); ++pair)
      if (cloud.apart(pair) <= 0) expected.push_back(pair);
    CHECK(expected.size() > 20);
    CHECK(found == expected);
  }
}

TEST_CASE("a search within a distance that shrinks finds the nearest pair") {
  Random random(8);
  for (const double size : {1.0, 0.01}) {  // overlapping bounds, and bounds that are apart
    Cloud cloud(60, 1, random);
    for (std::size_t k = 1; k < cloud.bounds.size(); ++k) {
      cloud.bounds[k].reach *= size;
      if (size < 1) cloud.bounds[k].middle.z() += 2;
    }
    const NearPairs near(61, cloud.pairs);
    double least = 1e300, nearest = 1e300;
    for (int pair = 0; pair < static_cast<int>(cloud.pairs.size()); ++pair) least = std::min(least, cloud.apart(pair));
    near.for_each_within(cloud.bounds, nearest, [&](int pair) { nearest = std::min(nearest, cloud.apart(pair)); });
    CHECK(nearest == least);
  }
}

TEST_CASE("the search compares few of the pairs of a sheet of spheres") {
  // All pairs within the distance are counted: four neighbours of each sphere.
  for (const int along : {10, 20}) {
    std::vector<NearPairs::Bound> bounds;
    std::vector<std::pair<int, int>> pairs;
    for (int k = 0; k < along * along; ++k) {
      bounds.push_back({Vector3(0, 0.11 * (k / along), 0.11 * (k % along)), 0.05, Vector3::Zero()});
      for (int l = 0; l < k; ++l) pairs.emplace_back(l, k);
    }
    int count = 0;
    NearPairs(along * along, pairs).for_each_within(bounds, 0.02, [&](int) { ++count; });
    CHECK(count == 2 * along * (along - 1));
  }
}
