// Tests of bodies in pieces: one file for all pieces, and their assembly.
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/common/files/hdf5_file.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/superelement/modal_damping.hpp"
#include "reduce/superelement/named_points.hpp"
#include "tests/support/cut_chain.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::test;
using Catch::Matchers::Contains;

TEST_CASE("a cut body is read from its file as it was written") {
  const TemporaryFolder folder;
  const CutBody body = cut_beam();
  write_cut_body(body, folder / "beam.h5");
  CHECK(holds_pieces(folder / "beam.h5"));
  const CutBody read = read_cut_body(folder / "beam.h5");
  CHECK(read.name == body.name);
  CHECK(read.input == body.input);
  REQUIRE(read.pieces.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(read.pieces[k].name == body.pieces[k].name);
    CHECK(read.pieces[k].stiffness == body.pieces[k].stiffness);
    CHECK(read.pieces[k].interfaces[1].name == body.pieces[k].interfaces[1].name);
    CHECK(read.pieces[k].loads.size() == body.pieces[k].loads.size());
    // A piece in its group equals a superelement in a separate file.
    const Superelement alone = read_superelement(SuperelementPlace(folder / "beam.h5", group_of_piece(k)));
    CHECK(alone.mass == body.pieces[k].mass);
  }
  REQUIRE(read.cuts.size() == 2);
  CHECK(read.cuts[1].name == "cut_2");
  CHECK(read.cuts[1].pieces == std::array<int, 2>{1, 2});
  CHECK(read.cuts[1].position == body.cuts[1].position);
  CHECK(read.cuts[1].area == 0.01);
  CHECK(read.cuts[1].distance == 1e-3);
  CHECK(read.free_frequencies == body.free_frequencies);
  CHECK(read.effect.uncut_frequencies == body.effect.uncut_frequencies);
  CHECK(read.effect.stiffness_ratios == body.effect.stiffness_ratios);
  CHECK(shared_interfaces(read.pieces) == std::vector<std::string>{"cut_1", "cut_2"});
}

TEST_CASE("the points of all pieces are found with their pieces") {
  const TemporaryFolder folder;
  CutBody body = cut_beam();
  body.pieces[0].points["a"] = {{0.1, 0, 0}, Eigen::MatrixXd::Random(6, body.pieces[0].size()), {}};
  body.pieces[2].points["b"] = {{0.9, 0, 0}, Eigen::MatrixXd::Random(6, body.pieces[2].size()), {}};
  write_cut_body(body, folder / "beam.h5");
  const auto points = read_points_of_file(folder / "beam.h5");
  REQUIRE(points.size() == 2);
  CHECK(points.at("a").group == "/pieces/1");
  CHECK(points.at("b").group == "/pieces/3");
  CHECK(points.at("b").point.shapes == body.pieces[2].points.at("b").shapes);
}

TEST_CASE("files of whole and of cut bodies are distinguished, and messages name the piece") {
  const TemporaryFolder folder;
  CutBody body = cut_beam();
  write_superelement(body.pieces[0], folder / "whole.h5");
  CHECK_FALSE(holds_pieces(folder / "whole.h5"));
  CHECK_FALSE(holds_pieces(folder / "none.h5"));
  const auto message = [&](const std::string& name) {
    return message_of<InputError>([&] { read_cut_body(folder / name); });
  };
  CHECK_THAT(message("whole.h5"), Contains("is no cut body"));

  write_cut_body(body, folder / "beam.h5");
  {
    Hdf5File file = Hdf5File::open_to_extend(folder / "beam.h5");
    file.remove("/pieces/2/reduced/stiffness");
    file.write("/pieces/2/reduced/stiffness", Eigen::MatrixXd(Eigen::MatrixXd::Identity(3, 4)), "-");
  }
  CHECK_THAT(message("beam.h5"), Contains("/pieces/2"));

  body.pieces[1].interfaces[0].position.y() = 1e-6;
  write_cut_body(body, folder / "moved.h5");
  CHECK_THAT(message("moved.h5"), Contains("the interface 'cut_1' of 'beam.2' differs"));
}

TEST_CASE("pieces that are joined again move as the beam that was cut") {
  const CutBody body = cut_beam();
  const Superelement whole = assembled(body.pieces);
  CHECK(whole.interfaces.size() == 4);
  CHECK(whole.size() == 4 * 6 + 3 * 3);
  CHECK(whole.modes() == 9);
  CHECK(whole.total_mass == Approx(1).epsilon(1e-12));
  CHECK(whole.centre.x() == Approx(0.5).epsilon(1e-12));
  // The inertia of a slender rod of mass and length 1 is 1/12, up to the rotary inertia of the beam's lumped points.
  CHECK(whole.inertia(1, 1) == Approx(1.0 / 12).epsilon(2e-3));
  const Eigen::MatrixXd rigid = rigid_motions(whole);
  CHECK((whole.stiffness * rigid).cwiseAbs().maxCoeff() < 1e-12 * whole.stiffness.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd mass = rigid.transpose() * whole.mass * rigid;
  CHECK(mass(0, 0) == Approx(1).epsilon(1e-12));
  CHECK(mass(1, 5) == Approx(0.5).epsilon(1e-12));

  // The tip of the clamped beam of length 1 moves by 1/(3 EI) and rotates by 1/(2 EI), which cubic elements represent
  // exactly.
  const BeamProperties beam;
  std::vector<Eigen::Index> loose;
  for (Eigen::Index k = 6; k < whole.size(); ++k) loose.push_back(k);
  const Eigen::MatrixXd compliance = bielle::regular_inverse(whole.stiffness(loose, loose)).value();
  const Eigen::Index tip = 12;  // root, cut_1, cut_2, tip, of which the root is held
  CHECK(compliance(tip + 1, tip + 1) == Approx(1 / (3 * beam.EIz)).epsilon(1e-9));
  CHECK(compliance(tip + 1, tip + 5) == Approx(1 / (2 * beam.EIz)).epsilon(1e-9));
}

TEST_CASE("one ratio damps the first mode of all pieces together") {
  const double omega = 5;
  for (const Superelement& piece : cut_beam().pieces) {
    // A mode v of the whole body with v^T M v = 1 has v^T K v = omega^2 and v^T C v = 2 zeta omega.
    const Eigen::MatrixXd damping = damping_of_piece(piece, 0.02, omega / (2 * std::acos(-1.0)));
    CHECK((damping * omega - 2 * 0.02 * piece.stiffness).norm() < 1e-14 * piece.stiffness.norm());
  }
}
