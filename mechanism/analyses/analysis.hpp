// An analysis: a computation of a session, with its records and its summary.
//
// A new analysis is a class derived from this one in its own file, with the reader of its keys, and a line in
// analysis_table.cpp. Reading, running, the results file and the summary then include it.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/session/session.hpp"

namespace bielle::mechanism {

struct AnalysisSummary {
  std::string text;  ///< text for the user: a heading, and lines below it
  long records = 0;  ///< number of rows
  /// Numerical results, by name: "limit_points".
  std::map<std::string, std::vector<double>> numbers;
};

class Analysis {
 public:
  /// @param type  as in the input file: "dynamic"
  explicit Analysis(std::string type) : type_(std::move(type)) {}
  virtual ~Analysis() = default;
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  const std::string& type() const { return type_; }
  /// Runs the analysis from the present state of the session. Rows and arrays go to the session's sinks.
  /// @throws InputError, ComputationError
  AnalysisSummary run(Session& session) const;
  /// Continues the analysis from the checkpoint of a sink, which has the earlier rows. @throws InputError if this is
  /// not possible
  AnalysisSummary go_on(Session& session, const std::vector<double>& checkpoint, ResultSink& sink) const;

  /// Sets the function that creates the model with another parameter, for analyses that sweep a parameter.
  virtual void set_maker(const ModelMaker& /*maker*/) {}

  /// Returns the time or load factor that the analysis has reached, for messages: "t = 0.3 s", "load factor 0.5".
  virtual std::string place(const Session& session) const;
  virtual bool can_go_on() const { return false; }  ///< whether sinks receive checkpoints
  /// Nodes and coordinates that keep their values during the assembly, for `--check`.
  virtual AssemblyOptions kept() const { return {}; }
  virtual double duration() const { return 0; }  ///< increase of the time [s]
  /// Expected number of rows; 0: unknown, or none.
  virtual std::size_t expected_rows(const Recording& /*recording*/) const { return 0; }

 private:
  virtual void solve(Session& session, AnalysisSummary& summary) const = 0;
  virtual void solve_rest(Session& session, const std::vector<double>& checkpoint, ResultSink& sink,
                          AnalysisSummary& summary) const;
  std::string type_;
};

}  // namespace bielle::mechanism
