// SPDX-License-Identifier: AGPL-3.0-or-later
// The part of the driver that decides whether a cycle is worse than the one before.
#include "tetradapt/adapt/driver.h"
#include "tetradapt/adapt/load_record.h"
#include "tetradapt/compare/root_of_squares.h"

#include <sstream>

namespace tetradapt::adapt
{
  namespace
  {
    /** A rejected cycle has no errors, whatever told that it is worse. */
    void
    leave_out_errors(CycleRecord &record)
    {
      for (auto CycleRecord::*figure : {&CycleRecord::mean_ren,
                                        &CycleRecord::max_ren,
                                        &CycleRecord::l2_error,
                                        &CycleRecord::relative_l2_error,
                                        &CycleRecord::h1_error,
                                        &CycleRecord::relative_h1_error,
                                        &CycleRecord::energy_error,
                                        &CycleRecord::relative_energy_error,
                                        &CycleRecord::estimate,
                                        &CycleRecord::relative_estimate,
                                        &CycleRecord::reference_error_estimate,
                                        &CycleRecord::effectivity})
        (record.*figure).reset();
      record.error_source              = ErrorSource::none;
      record.displacement_error_source = ErrorSource::none;
      record.estimate_source.clear();
      record.estimates.clear();
      record.goals.clear();
    }
  } // namespace

  bool
  Driver::compares_estimates(const Cycle &cycle) const
  {
    return !is_same_problem(change_of_problem(accepted->record, cycle.record), current.swept);
  }

  bool
  Driver::is_rejected_by_energy(Cycle &cycle)
  {
    if (!accepted)
      return false;
    const double     change = change_of_problem(accepted->record, cycle.record);
    const EnergyTest test = compare_energies(accepted->energy, cycle.energy, current.swept, change);
    if (!test.is_worse())
      return false;
    std::ostringstream text;
    text << "the potential energy is " << cycle.energy.potential << ", above the "
         << accepted->energy.potential;
    return reject(cycle, text.str());
  }

  void
  Driver::reject_by_estimate(Cycle &cycle)
  {
    const double before = compare::root_of_squares(accepted->indicators);
    const double after  = compare::root_of_squares(cycle.indicators);
    log.detail("Cycle " + std::to_string(cycle.record.cycle)
               + ": the loads or the volume changed with the mesh, so that estimates are "
                 "compared in place of energies.");
    if (!is_worse_estimate(before, after))
      return;
    std::ostringstream text;
    text << "the refinement indicator's estimate is " << after << ", above the " << before;
    if (!reject(cycle, text.str()))
      return;
    levels.pop_back();
    leave_out_errors(cycle.record);
    cycle.indicators.clear();
  }

  bool
  Driver::reject(Cycle &cycle, const std::string &reason)
  {
    std::ostringstream text;
    text << "Cycle " << cycle.record.cycle << ": with " << cycle.record.tets << " tetrahedra "
         << reason << " of cycle " << accepted->record.cycle << " with " << accepted->record.tets;
    if (n_rejected == 2)
      {
        // Even where every tetrahedron was cut; then it is not the mesh.
        log.warning(text.str()
                    + ", although every tetrahedron of that was cut into eight: the loads may "
                      "not be resolved by the mesh. The cycle is kept.");
        return false;
      }
    log.warning(text.str() + ": the solution is worse, and the mesh is rejected.");
    cycle.record.acceptance = Acceptance::rejected;
    return true;
  }
} // namespace tetradapt::adapt
