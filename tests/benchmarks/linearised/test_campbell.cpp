// Modes of rotors over their speed, against closed forms.
#include <cmath>

#include "mechanism/results/memory_sink.hpp"
#include "tests/benchmarks/linearised/modes_of.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_campbell {
namespace {

constexpr double Jp = 0.01, Jt = 0.02, mass = 5, k_tilt = 800, kx = 1.8e5, ky = 1e5, kz = 3e5;

/// Returns a rigid disc on an axle whose massless bearing rests on springs.
std::string disc(const std::string& analysis, const std::string& speed = "speed") {
  return fmt::format(
      "parameters: {{speed: 10}}\n"
      "nodes: {{hub: {{position: [0, 0, 0]}}, disc: {{position: [0, 0, 0], angular_velocity: [0, 0, \"{}\"]}}}}\n"
      "elements:\n  disc: {{type: rigid_body, node: disc, mass: {}, inertia: [{}, {}, {}]}}\n"
      "joints:\n  mount: {{type: bushing, nodes: [ground, hub], stiffness: [{}, {}, {}, {}, {}, 500]}}\n"
      "  axle: {{type: hinge, nodes: [hub, disc], position: [0, 0, 0], axis: [0, 0, 1]}}\n"
      "analysis: [{{type: campbell, {}}}]\n",
      speed, mass, Jt, Jt, Jp, kx, ky, kz, k_tilt, k_tilt, analysis);
}

/// G. Genta, Dynamics of Rotating Systems (2005), ch. 4: Jt w^2 -+ Jp Om w - k = 0.
double tilt(double speed, int sense) {
  const double gyro = sense * Jp * speed;
  return (gyro + std::sqrt(gyro * gyro + 4 * k_tilt * Jt)) / (2 * Jt);
}

struct Ran {
  MechanismFile file;
  Session session;
  MemorySink sink;
  AnalysisSummary summary;
  explicit Ran(const std::string& text)
      : file(read_mechanism_text(text, "model.yaml")), session(file.model), sink(file.model) {
    session.add_sink(sink);
    summary = file.analyses.at(0)->run(session);
  }
  std::vector<double> read(const char* name) const { return sink.read(0, fmt::format("campbell/{}", name)); }
};

}  // namespace

TEST_CASE("a disc's tilting splits forwards and backwards over the speed, and each keeps its number", "[linearised]") {
  const Ran ran(disc("parameter: speed, speeds: {from: 0, to: 420, count: 22}, modes: 5"));
  const std::vector<double> speed = ran.read("speed"), frequency = ran.read("damped_frequency"),
                            whirl = ran.read("whirl"), ratio = ran.read("damping_ratio");
  REQUIRE(speed.size() == 22);
  REQUIRE(frequency.size() == 22 * 5);
  // At rest the modes are along y, along x, tilts (twice 200), and along z.
  const auto at = [&](std::size_t k, std::size_t mode) { return two_pi * frequency[5 * k + mode]; };
  for (std::size_t k = 0; k < speed.size(); ++k) {
    CAPTURE(speed[k]);
    CHECK(speed[k] == Approx(20.0 * static_cast<double>(k)).margin(1e-12));
    CHECK(at(k, 0) == Approx(std::sqrt(ky / mass)).epsilon(1e-9));
    CHECK(at(k, 1) == Approx(std::sqrt(kx / mass)).epsilon(1e-9));
    CHECK(at(k, 2) == Approx(tilt(speed[k], -1)).epsilon(1e-9));
    CHECK(at(k, 3) == Approx(tilt(speed[k], 1)).epsilon(1e-9));
    CHECK(at(k, 4) == Approx(std::sqrt(kz / mass)).epsilon(1e-9));
    CHECK(std::abs(ratio[5 * k + 2]) < 1e-9);
    if (k == 0) continue;
    CHECK(whirl[5 * k] == Approx(0).margin(1e-6));
    CHECK(whirl[5 * k + 2] == Approx(-1).epsilon(1e-6));
    CHECK(whirl[5 * k + 3] == Approx(1).epsilon(1e-6));
    CHECK(std::isnan(whirl[5 * k + 4]));  // along the axis
  }
  CHECK_THAT(ran.summary.text, !Catch::Contains("warning") && !Catch::Contains("lost") && !Catch::Contains("veer"));
}

TEST_CASE("critical speeds of a disc are those of the closed form, and crossings are told where they are",
          "[linearised]") {
  const Ran ran(disc("parameter: speed, speeds: {from: 0, to: 420, count: 8}, modes: 5"));
  const std::vector<double> critical = ran.summary.numbers.at("critical_speed"), whirl = ran.read("critical_whirl");
  // The critical speeds of tilting are (Jt -+ Jp) Om^2 = k; the others are those of the translations.
  const std::vector<double> exact = {std::sqrt(ky / mass), std::sqrt(k_tilt / (Jt + Jp)), std::sqrt(kx / mass),
                                     std::sqrt(kz / mass), std::sqrt(k_tilt / (Jt - Jp))};
  check_rates(critical, exact, 1e-8);
  CHECK(whirl[1] == Approx(-1).epsilon(1e-6));
  CHECK(whirl[4] == Approx(1).epsilon(1e-6));
  // The frequency of the backward whirl falls through those of both translations; that of the forward whirl rises
  // through that of the motion along the axis.
  std::vector<double> crossings;
  for (const double w : {std::sqrt(kx / mass), std::sqrt(ky / mass)})
    crossings.push_back((k_tilt - Jt * w * w) / (Jp * w));
  crossings.push_back((Jt * kz / mass - k_tilt) / (Jp * std::sqrt(kz / mass)));
  std::vector<double> within;
  for (const double each : crossings)
    if (each < 420) within.push_back(each);
  std::sort(within.begin(), within.end());
  // The frequencies are linear between values that are a sixty-fourth of 60 rad/s apart.
  check_rates(ran.read("meeting_speed"), within, 1e-3);
}

TEST_CASE("a speed in other units and multiples of it", "[linearised]") {
  std::string text = disc("parameter: rpm, speeds: [600, 1200, 2400], modes: 4, orders: [0.5, 1, 2]", "rpm*pi/30");
  text.replace(text.find("speed: 10"), 9, "rpm: 1000");
  const Ran ran(text);
  CHECK(ran.read("speed")[1] == Approx(1200 * M_PI / 30).epsilon(1e-12));
  CHECK(ran.read("value") == std::vector<double>{600, 1200, 2400});
  const std::vector<double> speeds = ran.read("critical_speed"), orders = ran.read("critical_order"),
                            modes = ran.read("critical_mode");
  // Critical speeds with twice the speed: along y 141.4/2 = 70.7, along x 189.7/2 = 94.9, tilts with Jt 4 Om^2 -+ 2 Jp
  // Om^2 = k.
  std::vector<double> twice;
  for (std::size_t k = 0; k < speeds.size(); ++k)
    if (orders[k] == 2) twice.push_back(speeds[k]);
  check_rates(twice,
              {std::sqrt(ky / mass) / 2, std::sqrt(k_tilt / (4 * Jt + 2 * Jp)), std::sqrt(kx / mass) / 2,
               std::sqrt(k_tilt / (4 * Jt - 2 * Jp))},
              1e-8);
  CHECK_THAT(ran.summary.text, Catch::Contains("rpm = "));
}

TEST_CASE("Jeffcott's rotor on its shaft, in rotation as a whole", "[linearised]") {
  // H. H. Jeffcott, Phil. Mag. 37 (1919) 304: a disc in the middle of a light shaft, pinned at both ends, has the
  // critical speed sqrt(48 EI/(m L^3)), forwards and backwards alike, as it does not tilt.
  constexpr double EI = 2000, L = 1.2, m = 12;
  const std::string text = fmt::format(
      "nodes: {{a: {{position: [0, 0, 0], fixed: [x, y, z]}}, m: {{position: [{0}, 0, 0]}}, b: {{position: [{1}, 0, "
      "0], fixed: [y, z]}}}}\n"
      "elements:\n"
      "  left: {{type: beam, nodes: [a, m], elements: 6, orientation: [0, 1, 0], section: &s {{EA: 1e8, GAy: 1e8, GAz: "
      "1e8, GJ: 2000, EIy: {2}, EIz: {2}, mass_per_length: 1e-4, Jx: 2e-9, Jy: 1e-9, Jz: 1e-9}}}}\n"
      "  right: {{type: beam, nodes: [m, b], elements: 6, orientation: [0, 1, 0], section: *s}}\n"
      "  disc: {{type: rigid_body, node: m, mass: {3}, inertia: [0.2, 0.1, 0.1]}}\n"
      "analysis: [{{type: campbell, rotation: {{axis: [1, 0, 0]}}, speeds: {{from: 0, to: 100, count: 6}}, modes: "
      "2}}]\n",
      L / 2, L, EI, m);
  const Ran ran(text);
  const double exact = std::sqrt(48 * EI / (m * L * L * L));
  const std::vector<double> critical = ran.read("critical_speed"), whirl = ran.read("critical_whirl");
  CHECK_THAT(ran.summary.text, Catch::Contains("axes that do not turn"));
  // Six beam elements per half have an error of 1e-4.
  check_rates(critical, {exact, exact}, 1e-3);
  // The frequencies are equal at every speed, so that any combination of both whirls is a mode.
  CHECK(std::isnan(whirl[0]));
  for (const double f : ran.read("damped_frequency")) CHECK(f == Approx(exact / two_pi).epsilon(1e-3));
}

TEST_CASE("a sweep that has no speed, or a parameter that is not there, is refused", "[linearised]") {
  CHECK_THROWS_WITH(Ran(disc("parameter: speeed, speeds: {to: 100}")), Catch::Contains("did you mean 'speed'"));
  CHECK_THROWS_WITH(Ran(disc("speeds: {to: 100}")), Catch::Contains("expected the `parameter`"));
  CHECK_THROWS_WITH(Ran(disc("parameter: speed, speeds: [3, 2]")), Catch::Contains("more than the value before"));
  CHECK_THROWS_WITH(Ran(disc("parameter: speed, speeds: [0, 1]", "0*speed")), Catch::Contains("nothing turns"));
  CHECK_THROWS_WITH(Ran(disc("rotation: {axis: [0, 0, 1], rate: speed}, speeds: [0, 1]")),
                    Catch::Contains("the rates are the `speeds`"));
  CHECK_THROWS_WITH(Ran(disc("parameter: speed, speeds: [0, 1], node: ground")),
                    Catch::Contains("'ground' does not turn about the axis"));
  std::string failing = disc("parameter: speed, speeds: [0, 1, 2, 3]");
  failing.replace(failing.find("mass: 5"), 7, "mass: \"2*abs(speed - 1)\"");
  CHECK_THROWS_WITH(Ran(failing), Catch::StartsWith("model.yaml:") && Catch::Contains("elements.disc.mass") &&
                                      Catch::EndsWith("(where speed = 1)"));
}

}  // namespace test_campbell
