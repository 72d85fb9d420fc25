#include "reduce/superelement/adequacy_in_file.hpp"

#include <cmath>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/files/hdf5_file.hpp"

namespace bielle {

namespace {

/// Reads a vector whose size others determine, if it is present.
Eigen::VectorXd read_if_there(const Hdf5File& file, const std::string& name, Eigen::Index most) {
  const std::string dataset = "/adequacy/" + name;
  if (!file.has(dataset)) return Eigen::VectorXd(0);
  const Eigen::VectorXd numbers = file.read_vector(dataset);
  if (numbers.size() > most || !numbers.allFinite())
    throw InputError(fmt::format("{}: {}: expected at most {} finite numbers", file.place(), dataset, most));
  return numbers;
}

Eigen::Vector3d read_three(const Hdf5File& file, const std::string& name) {
  const std::string dataset = "/adequacy/" + name;
  const Eigen::VectorXd numbers = file.read_vector(dataset);
  if (numbers.size() != 3 || !numbers.allFinite())
    throw InputError(fmt::format("{}: {}: expected three finite numbers", file.place(), dataset));
  return numbers;
}

double read_finite(const Hdf5File& file, const std::string& name) {
  const std::string dataset = "/adequacy/" + name;
  const double number = file.read_number(dataset);
  if (!(number >= 0) || !std::isfinite(number))
    throw InputError(fmt::format("{}: {}: expected a finite number of at least 0", file.place(), dataset));
  return number;
}

void write_if_there(const Eigen::VectorXd& numbers, const std::string& name, const std::string& units,
                    const std::string& description, Hdf5File& file) {
  if (numbers.size() > 0) file.write("/adequacy/" + name, numbers, units, description);
}

}  // namespace

void write_adequacy(const Adequacy& adequacy, Hdf5File& file) {
  write_if_there(adequacy.frequencies, "free_frequencies", "Hz", "of the free reduced body, the lowest ones", file);
  write_if_there(adequacy.mode_error, "mode_error", "-", "part by which each is too high, since modes are left out",
                 file);
  write_if_there(adequacy.mode_mac, "mode_mac", "-", "modal assurance criterion of each with the mode of the mesh",
                 file);
  write_if_there(adequacy.mesh_error, "mesh_error", "-", "the same of the first ones, since the mesh is coarse", file);
  write_if_there(adequacy.tie_error, "tie_error", "-", "the same, at least, of rigid ties against average ones", file);
  write_if_there(adequacy.stress_error, "stress_error", "-",
                 "of stress in the energy norm, under a unit load on each kept interface direction", file);
  file.write("/adequacy/worst_place", Eigen::VectorXd(adequacy.worst_place), "m",
             "where the error of stress is largest");
  file.write("/adequacy/inertia_answer", Eigen::VectorXd(adequacy.inertia_answer), "-",
             "fraction of the held body's static response to accelerations along x y z that the modes represent");
  file.write("/adequacy/next_mode", adequacy.next_mode, "Hz", "first fixed-boundary mode left out; 0: unknown");
  file.write("/adequacy/wanted", adequacy.wanted, "Hz", "modes.below of the body file; 0: not given");
  file.write("/adequacy/element_order", static_cast<double>(adequacy.order), "-");
  file.write("/adequacy/one_element_thick", adequacy.one_element_thick, "-", "share of the surface");
  file.write("/adequacy/least_scaled_jacobian", adequacy.least_jacobian, "-");
  if (!adequacy.rigid_ties.empty()) file.write_names("/adequacy/rigid_ties", adequacy.rigid_ties);
}

std::optional<Adequacy> read_adequacy(const Hdf5File& file) {
  if (!file.has("/adequacy")) return std::nullopt;
  Adequacy result;
  constexpr Eigen::Index any = 1000000;
  result.frequencies = read_if_there(file, "free_frequencies", any);
  result.mode_error = read_if_there(file, "mode_error", result.frequencies.size());
  if (result.mode_error.size() != result.frequencies.size())
    throw InputError(
        fmt::format("{}: /adequacy/mode_error: expected one number for each of free_frequencies", file.place()));
  result.mode_mac = read_if_there(file, "mode_mac", result.frequencies.size());
  if (result.mode_mac.size() > 0 && result.mode_mac.size() != result.frequencies.size())
    throw InputError(
        fmt::format("{}: /adequacy/mode_mac: expected one number for each of free_frequencies", file.place()));
  result.mesh_error = read_if_there(file, "mesh_error", result.frequencies.size());
  result.tie_error = read_if_there(file, "tie_error", result.frequencies.size());
  result.stress_error = read_if_there(file, "stress_error", any);
  result.worst_place = read_three(file, "worst_place");
  result.inertia_answer = read_three(file, "inertia_answer");
  result.next_mode = read_finite(file, "next_mode");
  result.wanted = read_finite(file, "wanted");
  result.order = read_finite(file, "element_order") < 2 ? 1 : 2;
  result.one_element_thick = read_finite(file, "one_element_thick");
  result.least_jacobian = read_finite(file, "least_scaled_jacobian");
  if (file.has("/adequacy/rigid_ties")) result.rigid_ties = file.read_names("/adequacy/rigid_ties");
  return result;
}

}  // namespace bielle
