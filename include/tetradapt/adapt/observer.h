// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_observer_h
#define tetradapt_adapt_observer_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/nodal_field.h"
#include "tetradapt/scene/scene.h"

#include <optional>

namespace tetradapt::adapt
{
  /** The figures of one cycle. What a scene does not have stays empty. */
  struct CycleRecord
  {
    unsigned int          cycle  = 0;
    unsigned long         points = 0, tets = 0, dofs = 0;
    std::optional<double> mean_ren, max_ren;
    /** Against the truth where one is given, else against the reference. */
    std::optional<double> l2_error, relative_l2_error;
    std::optional<double> h1_error, relative_h1_error;
    std::optional<double> energy_error, relative_energy_error;
    /** The estimator's global value, energy norm, absolute and relative. */
    std::optional<double> estimate, relative_estimate;
    /** The reference's own estimated relative energy error. */
    std::optional<double> reference_error;
    /** estimate / energy_error, where a truth is known. */
    std::optional<double> effectivity;
    double                strain_energy    = 0.;
    double                max_displacement = 0.;
    unsigned int          iterations       = 0;
    double seconds_mesh = 0., seconds_solve = 0., seconds_estimate = 0., seconds_total = 0.;
  };

  /** One finished cycle; references are valid during the call only. */
  struct CycleEvent
  {
    const CycleRecord            &record;
    const mesh::NodalField       &displacement;
    const mechanics::MaterialMap &materials;
    const std::vector<double>    *indicators; ///< eta_K that drives, or null
    const std::vector<double>    *nodal_ren;  ///< one a node, or null
  };

  /** Watches a run. Called on MPI rank 0 only. */
  class Observer
  {
  public:
    virtual ~Observer() = default;

    virtual void
    run_started(const scene::Scene &)
    {
    }
    virtual void
    cycle_done(const CycleEvent &)
    {
    }
    /** @p reason says why the loop stopped, for the user. */
    virtual void
    run_done(const std::string & /*reason*/)
    {
    }
  };
} // namespace tetradapt::adapt

#endif
