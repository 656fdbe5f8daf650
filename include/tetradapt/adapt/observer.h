// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_observer_h
#define tetradapt_adapt_observer_h

#include "tetradapt/mechanics/loads.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/nodal_field.h"
#include "tetradapt/scene/scene.h"
#include "tetradapt/solve/equilibrium.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tetradapt::adapt
{
  /** What one estimator said in a cycle. */
  struct EstimateRecord
  {
    std::string           name; ///< EstimatorTraits::name
    scene::ErrorEstimator which          = scene::ErrorEstimator::spr;
    bool                  is_energy_norm = true;
    double                global         = 0.; ///< in the estimator's unit
    std::optional<double>
      relative; ///< an energy norm over that of the exact, else the own solution
    std::optional<double> effectivity; ///< over the true error, where that is known
    /** Of the local indices eta_K / e_K, where an exact displacement is known: the
     * standard deviation of their natural logarithms, each weighted by e_K^2. 0: each cell's
     * error is known up to one common factor. */
    std::optional<double> local_deviation;
    double                seconds = 0.;
  };

  /** A goal's value in a cycle. */
  struct GoalRecord
  {
    std::string           name;
    double                value = 0.;
    std::optional<double> exact;          ///< the scene's Exact value
    std::optional<double> error;          ///< exact - value
    std::optional<double> error_estimate; ///< with its sign, where the estimator 'goal' ran
    std::optional<double> effectivity;    ///< estimated over true error
  };

  /** The mesh of a cycle compared with what was asked for. */
  struct MeshRecord
  {
    std::optional<double> requested_tets;          ///< as the size field predicted
    unsigned long         oversized_tets     = 0;  ///< cells more than twice as large as asked for
    double                volume_drift       = 0.; ///< relative, against the first mesh
    double                largest_projection = 0.; ///< farthest way of a point to the boundary
    unsigned long         unprojected_points = 0;  ///< not moved, as a cell would be inverted
    double                min_dihedral = 0., max_dihedral = 0.; ///< degrees
    double                volume = 0.;
    /** Volume of the body: of the first mesh, or inside the surfaces that the boundary is
     * projected onto; 0: unknown. */
    double       body_volume      = 0.;
    unsigned int n_parts          = 0; ///< that hang together across faces; 0: unknown
    double       max_aspect_ratio = 0.;
    /** Cells by their smallest dihedral angle: below 5, 10, 20, 30, 40, 50, 60, and
     * above degrees. */
    std::array<unsigned long, 8> dihedral_histogram{};
    /** Boundary faces by id and cells by region, as one line. */
    std::string counts_by_id;
  };

  /** A point or a line where a support or a load acts: what errors leave out around it. */
  struct LeftOutRecord
  {
    std::string   name;          ///< "Loads/tip"
    std::string   place;         ///< "within 0.2 of (4, 0, 0)"; empty: nothing is left out
    double        radius   = 0.; ///< 0: nothing is left out
    bool          is_force = false;
    unsigned long n_cells  = 0; ///< of this cycle's mesh that are left out
  };

  /** What an error is measured against. */
  enum class ErrorSource
  {
    none,         ///< no error is measured
    exact,        ///< the exact displacement
    known_energy, ///< the exact solution's strain energy
    reference     ///< the reference solution
  };

  /** What became of a cycle's mesh. */
  enum class Acceptance
  {
    accepted,
    rejected ///< its energy, or its estimate, was worse than the one before; another mesh followed
  };

  /** What one load of the scene amounts to in a cycle. */
  struct LoadRecord
  {
    std::string          name;
    mechanics::LoadTotal total;
    /** Change of its force since the first cycle, relative to int |density|: of a boundary that
     * is projected, or of what quadrature left. */
    double drift = 0.;
  };

  /** The figures of one cycle. What a scene does not have stays empty. */
  struct CycleRecord
  {
    unsigned int          cycle  = 0;
    unsigned long         points = 0, tets = 0, dofs = 0;
    std::optional<double> mean_ren, max_ren;
    /** Measured against the exact solution where one is given, else against the reference.
     * Empty where there is neither: nothing here is estimated. */
    std::optional<double> l2_error, relative_l2_error;
    std::optional<double> h1_error, relative_h1_error;
    std::optional<double> energy_error, relative_energy_error;
    ErrorSource           error_source              = ErrorSource::none; ///< of energy_error
    ErrorSource           displacement_error_source = ErrorSource::none; ///< of L2, H1 and REN
    /** The difference to the reference, or without one the first estimator of the energy
     * norm: absolute and relative. */
    std::optional<double> estimate, relative_estimate;
    std::string           estimate_source; ///< "reference", or the estimator's name
    /** The reference's own relative energy error, as estimated or by the known energy. */
    std::optional<double> reference_error_estimate;
    /** estimate / energy_error, where the error is measured. */
    std::optional<double> effectivity;
    double                strain_energy = 0.;
    std::optional<double> spring_energy; ///< see solve::StaticSolution
    double                max_displacement        = 0.;
    unsigned int          iterations              = 0;
    unsigned int          iterations_to_tolerance = 0; ///< see solve::StaticSolution
    std::optional<double> algebraic_error;             ///< energy norm, estimated
    /** a(u_h,u_h). */
    double                      energy     = 0.;
    Acceptance                  acceptance = Acceptance::accepted;
    std::vector<EstimateRecord> estimates; ///< the refinement indicator first
    std::vector<GoalRecord>     goals;
    std::vector<LeftOutRecord>  left_out; ///< a point force or a support at a point or line each
    MeshRecord                  mesh;
    /** Reactions and loads, and how they balance. */
    std::optional<solve::Equilibrium> equilibrium;
    std::vector<LoadRecord>           loads; ///< in the order of the scene
    /** What is in each region, and the largest displacement and stress there. */
    std::vector<mechanics::RegionFigures> regions;
    double seconds_mesh = 0., seconds_solve = 0., seconds_estimate = 0., seconds_total = 0.;
  };

  inline bool
  is_true(const ErrorSource source)
  {
    return source == ErrorSource::exact || source == ErrorSource::known_energy;
  }

  /** The relative energy error of a cycle if one is measured, else the estimate. */
  inline std::optional<double>
  relative_error_or_estimate(const CycleRecord &record)
  {
    return record.relative_energy_error ? record.relative_energy_error : record.relative_estimate;
  }

  /** One finished cycle; references are valid during the call only. */
  struct CycleEvent
  {
    const CycleRecord            &record;
    const mesh::TetMesh          &mesh;
    const mesh::NodalField       *displacement; ///< null where the scene writes none
    const mechanics::MaterialMap &materials;
    const std::vector<double>    *indicators; ///< eta_K that drives, or null
    const std::vector<double>    *nodal_ren;  ///< one a node, or null
    /** The edge lengths that this cycle's mesh has, one a point of the mesh (see
     * obtained_sizes()), if the scene writes a size field; else null. */
    const std::vector<double> *node_sizes = nullptr;
  };

  struct StopDecision;

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
    /** @p decision says why the loop stopped. */
    virtual void
    run_done(const StopDecision & /*decision*/)
    {
    }
  };
} // namespace tetradapt::adapt

#endif
