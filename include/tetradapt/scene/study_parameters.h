// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_study_parameters_h
#define tetradapt_scene_study_parameters_h

#include "tetradapt/scene/error_estimator.h"
#include "tetradapt/scene/mesh_parameters.h"

#include <string>

/**
 * Every struct here has three functions: declare() adds its parameters, with its
 * present values as defaults, to the subsection that the ParameterHandler is in;
 * parse() reads them from there; check() looks at the values and throws
 * core::InputError "Section/Name: what is wrong and what to change".
 */
namespace tetradapt::scene
{
  struct SolverParameters
  {
    enum class Type
    {
      automatic, ///< direct below direct_limit unknowns, else cg
      cg,
      direct
    };
    Type         type           = Type::automatic;
    double       tolerance      = 1e-8; ///< of the residual, relative to the load
    unsigned int max_iterations = 2000;
    unsigned int direct_limit   = 2000; ///< unknowns
    /** What ends conjugate gradients. */
    enum class Stopping
    {
      residual,      ///< the tolerance
      discretisation ///< the iterate's own error, estimated, is small compared with that of the
                     ///< mesh
    };
    Stopping stopping = Stopping::residual;
    /** What solves the coarse problem of degree 1 in a step of multigrid. */
    enum class Multigrid
    {
      aggregation, ///< the program's own smoothed aggregation
      trilinos     ///< that of Trilinos (ML)
    };
    Multigrid multigrid             = Multigrid::aggregation;
    double    solver_error_fraction = 0.1; ///< discretisation: of the error of the mesh

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };

  /** The fine solution that others are compared with. */
  struct ReferenceParameters
  {
    enum class Type
    {
      none,
      fine_mesh, ///< solved by this program on a fine mesh, and cached
      hexahedra, ///< solved on an adaptive hexahedral mesh of a box-like body
      run        ///< a .vtu written by an earlier run
    };
    Type         type   = Type::none;
    unsigned int degree = 2; ///< fine_mesh: 1, 2; hexahedra: 2, 3
    /** fine_mesh: how the mesh is made: refined by TetGen from the scene's
     * initial mesh with the bounds below, or bricks, or read from a file. */
    enum class MeshRoute
    {
      refine,
      bricks,
      file
    };
    MeshRoute                   route = MeshRoute::refine;
    std::array<unsigned int, 3> cells{{1, 1, 1}};  ///< bricks
    double                      volume_bound = 0.; ///< refine
    std::string                 size;              ///< refine: edge length in x, y, z
    double                      radius_edge_ratio = 1.414;
    double                      dihedral_angle    = 10.;
    std::string                 file; ///< file: volume mesh; run: .vtu of a run
    /** hexahedra: refined until its own estimated relative energy error is below; 0:
     * a tenth of Adaptivity/Tolerance, or of 0.01 if there is none. */
    double        tolerance = 0.;
    unsigned long max_dofs  = 2000000; ///< hexahedra: no larger system
    bool          cache     = true;
    std::string   cache_directory; ///< default: output/cache below the working directory

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };

  struct AdaptivityParameters
  {
    enum class Strategy
    {
      none,      ///< one mesh
      mesh_list, ///< one cycle for each mesh that Mesh lists
      uniform,   ///< every tetrahedron cut into 8, each cycle
      adaptive
    };
    /** Which indicator drives the refinement. */
    using RefinementIndicator = ErrorEstimator;
    enum class Marking
    {
      maximum,        ///< eta_K >= lambda max eta
      fixed_fraction, ///< the given fraction of the cells with the largest eta_K
      doerfler,       ///< smallest set with theta of the squared error
      optimal_size    ///< no marking: a size field that equidistributes the error
    };
    /** How sizes are given to TetGen. */
    enum class SizeControl
    {
      node_sizes,        ///< an edge length at every node (-m)
      volume_constraints ///< a bound on the volume of every tetrahedron (-a)
    };
    Strategy            strategy             = Strategy::none;
    RefinementIndicator refinement_indicator = RefinementIndicator::energy;
    Marking             marking              = Marking::optimal_size;
    SizeControl         size_control         = SizeControl::node_sizes;

    double lambda  = 0.8;   ///< maximum rule
    double min_new = 0.05;  ///< maximum rule: lambda is lowered until at least this fraction of the
                            ///< cells is marked
    double fraction  = 0.2; ///< fixed fraction
    double theta     = 0.5; ///< doerfler
    double reduction = 0.5; ///< new edge length over old one of a marked cell
    double growth    = 3.;  ///< optimal size: tetrahedra of the next mesh over this one's
    double min_ratio = 0.2; ///< clamp of new over old size in one cycle
    double max_ratio = 2.;
    double min_size  = 0.;  ///< smallest edge length; 0: none
    double max_size  = 0.;  ///< largest edge length; 0: none
    double gradation = 0.5; ///< h(x) <= h(y) + g |x-y|
    /** A cycle whose energy says that the solution is worse is not accepted: the mesh
     * before is refined more strongly, then uniformly. */
    bool safeguard = true;
    /** Elements may grow: a new mesh of the body with the size field as background,
     * instead of refining the old one. */
    bool coarsening = false;
    /** Stop when the relative energy error (estimated, or true where known) is
     * below; 0: no such stop. */
    double        tolerance      = 0.;
    double        ren_tolerance  = 0.;      ///< the same for the mean REN
    double        goal_tolerance = 0.;      ///< relative error of Estimation/Goal; 0: no such stop
    unsigned int  max_cycles     = 5;       ///< uniform, adaptive; the first mesh counts
    unsigned long max_tets       = 1000000; ///< 0: no limit
    unsigned long max_dofs       = 0;
    double        max_seconds    = 0.;

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };

  struct OutputParameters
  {
    std::string directory;          ///< empty: output/<scene's name>
    bool        tables     = true;  ///< convergence.csv, convergence.txt
    bool        vtu        = true;  ///< cycle_NNN.vtu and the .pvd
    bool        stress     = true;  ///< stress and von Mises in the .vtu
    bool        plots      = false; ///< SVG by gnuplot
    bool        size_field = false; ///< size_field.vtu, from which another scene can start

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };
} // namespace tetradapt::scene

#endif
