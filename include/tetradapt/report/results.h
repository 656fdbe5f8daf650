// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_results_h
#define tetradapt_report_results_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/core/log.h"
#include "tetradapt/report/result_folder.h"

#include <optional>
#include <string>
#include <vector>

namespace tetradapt::report
{
  /** A quantity that a run was to find, and what is known of it. */
  struct Result
  {
    std::string           name;
    std::optional<double> exact;
    double                computed = 0.;
    std::optional<double> error;          ///< exact - computed
    std::optional<double> error_estimate; ///< by the estimator 'goal', with its sign
    /** What error is measured against ("exact", "known energy"), else what gives
     * error_estimate ("estimate goal"); empty: nothing tells. */
    std::string error_source;

    /** |error / exact|. */
    std::optional<double>
    relative_error() const;
  };

  /**
   * What @p record says of everything that @p scene knows exactly or calls a goal: the strain
   * energy and the known one, the relative errors in norms (whose exact value is zero), and
   * the goals. Empty if the scene has neither an exact solution nor goals.
   */
  std::vector<Result>
  results_of(const scene::Scene &scene, const adapt::CycleRecord &record);

  /** What else is known of the solution of @p record: volume against that of the body, mass, parts,
   * the largest figures of each region, forces and moments of supports and loads, and their
   * imbalance. */
  std::vector<Result>
  results_of_solution(const adapt::CycleRecord &record);

  /** results.csv: a row a result, 10 significant digits, nothing where a figure is not
   * known. */
  std::string
  csv_results(const std::vector<Result> &results);

  /** The same for reading. */
  std::string
  text_results(const std::vector<Result> &results);

  /**
   * Says in the end what the run has found: the results of the last cycle that was
   * accepted go to results.csv and results.txt, and what is known exactly and goals also to the
   * log.
   */
  class ResultsSummary : public adapt::Observer
  {
  public:
    /** @param folder where the files go; null: none are written. Must outlive the object.
     * @param log must outlive the object. */
    ResultsSummary(ResultFolder *folder, const core::Log &log);

    void
    run_started(const scene::Scene &scene) override;
    void
    cycle_done(const adapt::CycleEvent &event) override;
    /** @throws InputError or NumericalError if a file cannot be written. */
    void
    run_done(const adapt::StopDecision &decision) override;

  private:
    ResultFolder                     *folder;
    const core::Log                  &log;
    scene::Scene                      scene;
    std::optional<adapt::CycleRecord> last;
  };
} // namespace tetradapt::report

#endif
