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

/// Reads `{from: 1, to: 100, count: 200, spacing: logarithmic}`, or a list.
std::vector<double> read_frequencies(const YamlValue& entry) {
  std::vector<double> frequencies;
  if (entry.is_sequence()) {
    for (const YamlValue& item : entry.items()) {
      frequencies.push_back(item.number());
      if (frequencies.back() < 0) item.fail("expected a frequency of 0 or more [Hz]");
    }
    if (frequencies.empty()) entry.fail("expected at least one frequency");
    return frequencies;
  }
  entry.check_keys({"from", "to", "count", "spacing"}, "`frequencies`");
  const bool even = entry.has("spacing") && entry.at("spacing").word({"logarithmic", "even"}, "a spacing") == "even";
  const double from = even ? entry.at("from").number() : entry.at("from").positive_number();
  const double to = entry.at("to").positive_number();
  if (from < 0) entry.at("from").fail("expected a frequency of 0 or more [Hz]");
  if (to <= from) entry.at("to").fail("expected more than `from`");
  const int count = entry.has("count") ? entry.at("count").integer() : 200;
  if (count < 2) entry.at("count").fail("expected at least 2 frequencies");
  for (int k = 0; k < count; ++k) {
    const double part = static_cast<double>(k) / (count - 1);
    frequencies.push_back(even ? from + part * (to - from) : from * std::pow(to / from, part));
  }
  return frequencies;
}

}  // namespace

std::unique_ptr<Analysis> read_frequency_response(const YamlValue& entry, const Model& model) {
  entry.check_keys({"type", "inputs", "outputs", "frequencies", "rotation", "modes"},
                   "the analysis 'frequency_response'");
  FrequencyResponseOptions options;
  options.inputs = read_response_inputs(entry, model);
  options.outputs = read_response_outputs(entry, model);
  options.frequencies = read_frequencies(entry.at("frequencies"));
  if (const auto rotation = entry.find("rotation")) options.rotation = read_rotation(*rotation);
  if (const auto modes = entry.find("modes")) {
    options.modes = modes->integer();
    if (options.modes < 1)
      modes->fail("expected at least one mode; without `modes` each frequency is answered directly");
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
