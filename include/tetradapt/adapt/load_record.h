// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_load_record_h
#define tetradapt_adapt_load_record_h

#include "tetradapt/adapt/doubts.h"
#include "tetradapt/adapt/observer.h"

namespace tetradapt::adapt
{
  /** Fills record.loads from the totals of this cycle's mesh and those of the first cycle
   * (@p first, empty in that cycle). */
  void
  describe_loads(const scene::Scene                      &scene,
                 const std::vector<mechanics::LoadTotal> &totals,
                 const std::vector<LoadRecord>           &first,
                 CycleRecord                             &record);

  /** Lines for the log: how well each load that varies is known, and how it was looked at. */
  std::vector<std::string>
  load_lines(const CycleRecord &record);

  /** How well a load is known, and how much it changed since the first mesh, as the rest of a
   * sentence "the load is ..."; empty if there is nothing to say. */
  std::string
  accuracy_of(const LoadRecord &load);

  /** Loads of which quadrature left more than a thousandth. */
  std::vector<Doubt>
  doubts_about_loads(const CycleRecord &record);

  /**
   * How much the problem of one cycle differs from that of another: the largest change of a
   * load (force, moment over half the body's size, int |density|), relative to int |density|, or of
   * the volume, relative to it. The same on every rank.
   */
  double
  change_of_problem(const CycleRecord &before, const CycleRecord &after);

  /** Whether the bound of an equilibrated stress is one without reserve: all loads are integrated
   * to LoadTotal::is_converged(), and displacements are prescribed by constants. */
  bool
  bound_is_guaranteed(const scene::Scene &scene, const CycleRecord &record);
} // namespace tetradapt::adapt

#endif
