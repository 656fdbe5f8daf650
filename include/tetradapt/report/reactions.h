// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_reactions_h
#define tetradapt_report_reactions_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/report/result_folder.h"

#include <string>
#include <vector>

namespace tetradapt::report
{
  /** Components of forces and of moments below these are what a solver leaves. */
  struct ForceNoise
  {
    double force = 0., moment = 0.;
  };

  /** What is allowed of the imbalance, but between 1e-9 and 1e-6 of all forces. */
  ForceNoise
  force_noise(const solve::Equilibrium &equilibrium);

  /** reactions.csv: for each cycle a row for each support and load, and one for what is left of
   * their sum; columns as in doc/columns.md. */
  std::string
  csv_reactions(const std::vector<adapt::CycleRecord> &records);

  /** regions.csv: for each cycle a row for each region; columns as in doc/columns.md. */
  std::string
  csv_regions(const std::vector<adapt::CycleRecord> &records);

  /** The reactions and loads of a cycle for reading, with the imbalance and what is allowed of
   * it; lines of at most 80 characters unless names are long. */
  std::string
  text_reactions(const solve::Equilibrium &equilibrium);

  /** The regions of a cycle for reading: contents, and the largest figures with their places. */
  std::string
  text_regions(const std::vector<mechanics::RegionFigures> &regions);

  /** Writes reactions.csv and regions.csv, which are whole at any time. */
  class ReactionsTable : public adapt::Observer
  {
  public:
    /** @param folder where the files go; must outlive this. */
    explicit ReactionsTable(ResultFolder &folder);

    void
    run_started(const scene::Scene &scene) override;
    /** @throws InputError or NumericalError if a file cannot be written. */
    void
    cycle_done(const adapt::CycleEvent &event) override;

  private:
    ResultFolder                   &folder;
    std::vector<adapt::CycleRecord> records;
  };
} // namespace tetradapt::report

#endif
