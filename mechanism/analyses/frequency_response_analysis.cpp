#include "mechanism/analyses/frequency_response_analysis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/response_reader.hpp"
#include "mechanism/analyses/rotation_reader.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "reduce/common/counted.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& frequencies_keys() {
  using namespace keys;
  static const KeyTable table{"`frequencies`",
                              "A range of frequencies.",
                              {{"from", number("Hz").non_negative(), required,
                                "The first frequency, greater than 0 if the spacing is not even."},
                               {"to", number("Hz").positive(), required, "The last frequency, greater than `from`."},
                               {"count", integer().at_least(2), otherwise("200"), "Number of frequencies."},
                               {"spacing", word({"logarithmic", "even"}, "a spacing"), otherwise("logarithmic"),
                                "Distances of the frequencies: in equal ratios, or `even`."}}};
  return table;
}

/// Reads a range of frequencies, or a list.
std::vector<double> read_frequencies(const YamlValue& entry) {
  std::vector<double> frequencies;
  if (entry.is_sequence()) {
    for (const YamlValue& item : entry.items()) frequencies.push_back(item.number());
    if (frequencies.empty()) entry.fail("expected at least one frequency");
    return frequencies;
  }
  const bool even = entry.at("spacing").word() == "even";
  const double from = entry.at("from").number(), to = entry.at("to").number();
  if (from == 0 && !even) entry.at("from").fail("expected a frequency greater than 0, or `spacing: even`");
  if (to <= from) entry.at("to").fail("expected more than `from`");
  const int count = entry.at("count").integer();
  for (int k = 0; k < count; ++k) {
    const double part = static_cast<double>(k) / (count - 1);
    frequencies.push_back(even ? from + part * (to - from) : from * std::pow(to / from, part));
  }
  return frequencies;
}

}  // namespace

const KeyTable& frequency_response_keys() {
  using namespace keys;
  static const KeyTable table{
      "the analysis 'frequency_response'", "Harmonic responses of small motions.",
      joined({{analysis_type_key("frequency_response")},
              response_keys(),
              {{"frequencies",
                {list_of(number("Hz").non_negative()).items_at_least(1), nested(frequencies_keys)},
                required,
                "The frequencies, as a list or a range."},
               {"modes", integer().at_least(1), optional,
                "Number of the slowest modes over which responses are summed; without the key each frequency is solved "
                "directly."},
               rotation_key()}})};
  return table;
}

std::unique_ptr<Analysis> read_frequency_response(const YamlValue& entry, const Model& model) {
  FrequencyResponseOptions options;
  options.inputs = read_response_inputs(entry, model);
  options.outputs = read_response_outputs(entry, model);
  options.frequencies = read_frequencies(entry.at("frequencies"));
  if (const auto rotation = entry.find("rotation")) options.rotation = read_rotation(*rotation, model);
  if (const auto modes = entry.find("modes")) {
    options.modes = modes->integer();
    if (std::all_of(options.frequencies.begin(), options.frequencies.end(), [](double f) { return f == 0; }))
      modes->fail("a sum over modes is for frequencies above 0; the answer at 0 alone is found directly");
  }
  return std::make_unique<FrequencyResponseAnalysis>(std::move(options));
}

void FrequencyResponseAnalysis::solve(Session& session, AnalysisSummary& summary) const {
  const FrequencyResponse result = compute_frequency_response(session, options_);
  const std::size_t frequencies = options_.frequencies.size(), outputs = options_.outputs.size(),
                    inputs = options_.inputs.size();
  std::vector<double> numbers;
  for (const Eigen::MatrixXcd& H : result.response)
    for (Eigen::Index i = 0; i < H.rows(); ++i)
      for (Eigen::Index j = 0; j < H.cols(); ++j) numbers.insert(numbers.end(), {H(i, j).real(), H(i, j).imag()});
  std::vector<std::string> input_names, output_names;
  for (const ResponseInput& input : options_.inputs) input_names.push_back(input.name);
  for (std::size_t k = 0; k < outputs; ++k)
    output_names.push_back(fmt::format("{} [{}]", options_.outputs[k].name, result.output_units[k]));
  session.write({"frequency_response/frequency", {frequencies}, options_.frequencies, "Hz", ""});
  session.write(
      {"frequency_response/response",
       {frequencies, outputs, inputs, 2},
       numbers,
       "-",
       "complex amplitude of each output per unit of each input: real and imaginary part of Re(H exp(i w t))"});
  session.write(ResultNames{"frequency_response/inputs", input_names});
  session.write(ResultNames{"frequency_response/outputs", output_names});
  summary.text =
      fmt::format("frequency_response, {} from {:.6g} to {:.6g} Hz\n", counted(frequencies, "frequency", "frequencies"),
                  options_.frequencies.front(), options_.frequencies.back());
  summary.text += format_setting(result, "responses");
  if (result.modal) {
    const ModalAccuracy& modal = *result.modal;
    session.write(
        {"frequency_response/deviation", {}, {modal.deviation}, "-", "the largest from a direct answer, of it"});
    summary.numbers["deviation"].push_back(modal.deviation);
    summary.text += fmt::format(
        "  by {} up to {:.6g} Hz, and the residual of the others from direct answers at {} frequencies; where it was "
        "compared with others, it differs by at most {:.2g} of the answer (at {:.6g} Hz)\n",
        counted(modal.modes, "mode"), modal.fastest, modal.direct, modal.deviation, modal.frequency);
    constexpr double worth_a_warning = 0.05;
    if (modal.deviation > worth_a_warning)
      summary.text += "  warning: take more `modes`, up to one and a half times the highest frequency\n";
  }
  for (std::size_t i = 0; i < outputs; ++i)
    for (std::size_t j = 0; j < inputs; ++j) {
      const auto size = [&](std::size_t k) {
        return std::abs(result.response[k](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
      };
      std::size_t most = 0;
      for (std::size_t k = 1; k < frequencies; ++k)
        if (size(k) > size(most)) most = k;
      summary.numbers["peak"].push_back(size(most));
      summary.numbers["peak_frequency"].push_back(options_.frequencies[most]);
      summary.text += fmt::format("  {} per unit of {}: at most {:.6g}, at {:.6g} Hz\n", output_names[i],
                                  input_names[j], size(most), options_.frequencies[most]);
    }
}

}  // namespace bielle::mechanism
