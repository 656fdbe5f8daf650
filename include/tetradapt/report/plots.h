// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_plots_h
#define tetradapt_report_plots_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/report/gnuplot.h"
#include "tetradapt/report/result_folder.h"

#include <map>
#include <string>
#include <vector>

namespace tetradapt::report
{
  /** A run of a study, as its plots show it: one curve. */
  struct PlottedRun
  {
    std::string                     label;
    unsigned int                    degree  = 1; ///< of its elements
    unsigned int                    colour  = 0; ///< see PlotCurve
    unsigned int                    pattern = 0;
    std::vector<adapt::CycleRecord> records;
  };

  /** A plot and the name of its files, without an ending. */
  struct NamedPlot
  {
    std::string name, script;
  };

  /**
   * Pictures of one run: errors and estimates of all estimators against unknowns
   * (convergence_dofs) and against the seconds until then (convergence_seconds), with the
   * slopes of theory; effectivity; mean and largest REN (ren); shapes of the cells of the
   * first, the middle and the last mesh (quality). Empty scripts where the run lacks what
   * one would show, or had one cycle only.
   */
  std::vector<NamedPlot>
  plots_of_run(const scene::Scene &scene, const std::vector<adapt::CycleRecord> &records);

  /** Pictures of a study, a curve a run: the energy error against unknowns and seconds, the
   * effectivity of what drives, mean REN against cycles and against tetrahedra (ren_tets), the
   * error of the first goal with a known value (goal_dofs).
   * @param key what colours and lines stand for; may be empty. */
  std::vector<NamedPlot>
  plots_of_study(const std::string             &title,
                 const std::vector<PlottedRun> &runs,
                 const std::string             &key = "");

  /** The effectivity of the estimator that drives, or where it has none that of the
   * difference to the reference. */
  std::optional<double>
  main_effectivity(const adapt::CycleRecord &record);

  /** Best slopes in unknowns for elements of the degrees in use: the energy norm's, and
   * with @p with_l2 those of L2 also. */
  std::vector<PlotSlope>
  theoretical_slopes(const std::vector<unsigned int> &degrees, bool with_l2);

  /** Counts of positive values in classes of a fifth of a power of ten each: number of the
   * class, floor(5 log10 value), to count. */
  std::map<int, unsigned long>
  logarithmic_histogram(const std::vector<double> &values);

  /** Numbers of the cycles that a histogram shows, of @p n: first, middle and last. */
  std::vector<std::size_t>
  chosen_cycles(std::size_t n);

  /** "cycle 3, 1234 tets" */
  std::string
  cycle_label(const adapt::CycleRecord &record);

  /** Collects the cycles of a run and draws plots_of_run() in the end, and the indicators
   * that drove it as histograms. */
  class RunPlots : public adapt::Observer
  {
  public:
    /** Plots go to the folder "plots" in @p folder. Both arguments must outlive the object. */
    RunPlots(ResultFolder &folder, const core::Log &log);

    void
    run_started(const scene::Scene &scene) override;
    void
    cycle_done(const adapt::CycleEvent &event) override;
    void
    run_done(const adapt::StopDecision &decision) override;

  private:
    /** Indicators of the first, the middle and the last cycle that had some. */
    LinePlot
    indicator_plot() const;

    ResultFolder                             &folder;
    const core::Log                          &log;
    scene::Scene                              scene;
    std::vector<adapt::CycleRecord>           records;
    std::vector<std::map<int, unsigned long>> indicators; ///< one a cycle; may be empty
  };

  /** Draws the plots of a study into the folder "plots" in @p folder; at most the first
   * 28 runs, which is what colours and lines can tell apart, and the log says so. */
  void
  draw_study(ResultFolder                  &folder,
             const std::string             &title,
             const std::vector<PlottedRun> &runs,
             const std::string             &key,
             const core::Log               &log);
} // namespace tetradapt::report

#endif
