#include "reduce/reduction/reduce_pieces.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reduce/common/build.hpp"
#include "reduce/common/error.hpp"
#include "reduce/fe/solid.hpp"
#include "reduce/reduction/added_masses.hpp"
#include "reduce/reduction/basis.hpp"
#include "reduce/reduction/cut_effect.hpp"
#include "reduce/reduction/told_masses.hpp"
#include "reduce/superelement/assembled_pieces.hpp"

namespace bielle::reduce {

namespace {

void check_damping(const ReductionOptions& options, Progress& progress) {
  if (options.damping_ratios.size() > 1)
    throw InputError("damping", "a body in pieces has one ratio, that of its first free mode: expected a number",
                     Subject::hidden);
  if (options.rayleigh && options.rayleigh->front() > 0)
    progress.warn("damping",
                  "alpha damps the deformation of each piece alone: it hardly damps the body's low modes, in which "
                  "pieces move almost as rigid bodies",
                  Subject::hidden);
}

/// Names the nodes of free ties by their number in the mesh: adjacent pieces must use the same name for a common node.
void rename_free_nodes(const ReductionOptions& options, const std::vector<int>& nodes, Superelement& piece) {
  for (const InterfaceRequest& request : options.interfaces) {
    if (request.tie != Tie::free) continue;
    const std::string prefix = request.name + "_";
    for (Interface& interface : piece.interfaces)
      if (interface.name.starts_with(prefix))
        interface.name = prefix + std::to_string(nodes.at(std::stoul(interface.name.substr(prefix.size()))));
  }
}

/// Reduces one piece. Neither its phases nor its notes are shown: the comparison with the uncut body replaces the notes
/// on ties.
Superelement reduce_part(const Mesh& mesh, const ReductionOptions& options, Progress part, int threads,
                         const MatrixMaker& make) {
  try {
    return reduce_body(mesh, options, part, threads, nullptr, make);
  } catch (const ComputationError& error) {
    throw ComputationError(error.subject(), fmt::format("{}: {}", options.name, error.what()), Subject::hidden);
  }
}

/// Reduces the body in one piece, with twice as many modes as the pieces have together, so that the number of modes
/// does not dominate the comparison: long modes of a whole body converge more slowly than the short ones of its pieces.
Superelement reduce_uncut(const Mesh& mesh, const ReductionOptions& options, Eigen::Index modes, int threads,
                          const Progress& progress, const MatrixMaker& make) {
  ReductionOptions uncut = options;
  const auto most = static_cast<int>(mesh.point_count() / 4);  // a tiny mesh has few
  uncut.modes.count = std::min(std::max(2 * static_cast<int>(modes), 40), most);
  uncut.modes.below.reset();
  uncut.loads.clear();
  uncut.points.clear();
  uncut.damping_ratios.clear();
  uncut.rayleigh.reset();
  uncut.judged = false;
  uncut.displacement_recovery = uncut.stress_recovery = RecoveryExtent::none;
  return reduce_part(mesh, uncut, progress.of_part("uncut body"), threads, make);
}

std::vector<Check> check_masses(const Superelement& whole, const MassProperties& uncut) {
  const ReducedMassProperties found = reduced_mass_properties(whole);
  return {
      {"mass_error", std::abs(found.mass / uncut.mass - 1), 1e-10, "the mass of all pieces is that of the uncut mesh"},
      {"centre_error", (found.centre - uncut.centre).norm() / radius_of_gyration(uncut), 1e-10,
       "their centre of mass is that of the uncut mesh, in radii of gyration"},
      {"inertia_error", (found.inertia - uncut.inertia).norm() / uncut.inertia.norm(), 1e-10,
       "their inertia is that of the uncut mesh"}};
}

}  // namespace

CutBody reduce_pieces(const Mesh& mesh, const std::vector<CutPlane>& planes, const ReductionOptions& options,
                      const PiecesRequest& request, Progress& progress, int threads, std::vector<Check>* checks,
                      const MatrixMaker& make) {
  check_damping(options, progress);
  progress.start("cutting");
  const CutMesh cut = cut_mesh(mesh, planes, options.interfaces.empty() ? "" : options.interfaces.front().group);
  CutBody body;
  body.name = options.name;
  body.created_by = created_by("bielle-reduce");
  body.input = options.input_text;
  body.cuts = cut_surfaces(cut);
  const std::vector<ReductionOptions> of_pieces = piece_options(mesh, cut, planes, body.cuts, options, request.tie);
  for (std::size_t k = 0; k < cut.pieces.size(); ++k) {
    progress.start(fmt::format("piece {} of {}", k + 1, cut.pieces.size()));
    body.pieces.push_back(
        reduce_part(cut.pieces[k].mesh, of_pieces[k], progress.of_part(of_pieces[k].name), threads, make));
    rename_free_nodes(of_pieces[k], cut.pieces[k].nodes, body.pieces.back());
  }

  progress.start("assembled pieces");
  const Superelement whole = assembled(body.pieces);
  body.free_frequencies = free_frequencies(whole);
  if (!options.damping_ratios.empty() && body.free_frequencies.size() > 0)
    for (Superelement& piece : body.pieces)
      piece.damping = damping_of_piece(piece, options.damping_ratios.front(), body.free_frequencies(0));
  const Solid solid = requested_solid(mesh, options);
  const AddedMasses masses(solid, options.masses, options.name);
  for (const std::string& told : told_masses(solid, masses, options)) progress.note(told);
  const std::vector<Check> found = check_masses(whole, with_masses(mass_properties(solid), masses));
  fail_when_a_check_does(found, "the assembled pieces");
  if (checks) *checks = found;
  if (request.compare) {
    progress.start("uncut body");
    Eigen::Index modes = 0;
    for (const Superelement& piece : body.pieces) modes += piece.fixed_boundary_modes();
    const Superelement uncut = reduce_uncut(mesh, options, modes, threads, progress, make);
    body.effect = {free_frequencies(uncut), stiffness_ratios(whole, uncut)};
  }
  progress.finish();
  return body;
}

}  // namespace bielle::reduce
