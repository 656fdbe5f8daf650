// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_mesh_parameters_h
#define tetradapt_scene_mesh_parameters_h

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

/**
 * Every struct here has three functions: declare() adds its parameters, with its
 * present values as defaults, to the subsection that the ParameterHandler is in;
 * parse() reads them from there; check() looks at the values and throws
 * core::InputError "Section/Name: what is wrong and what to change".
 */
namespace tetradapt::scene
{
  using dealii::Point;

  enum class MeshSource
  {
    box,    ///< an axis-parallel box meshed by TetGen
    blocks, ///< a union of axis-parallel boxes meshed by TetGen
    bricks, ///< n x n x m bricks cut into 6 tetrahedra each
    file,   ///< a volume mesh: .msh (2, 4), .vtk, .vtu, .node/.ele/.face
    surface ///< a closed surface (.stl, .off, .obj, .ply) meshed by TetGen
  };

  /**
   * Where a mesh comes from. Lists with more than one entry (bricks, files,
   * volume bounds) ask for a study: one cycle a mesh.
   */
  struct MeshParameters
  {
    MeshSource source = MeshSource::box;
    /** box, bricks: opposite corners. Boundary ids 1..6 with the names x-min,
     * x-max, y-min, y-max, z-min, z-max. */
    Point<3> lower_corner{0., 0., 0.};
    Point<3> upper_corner{1., 1., 1.};
    /** bricks: numbers of bricks along x, y, z. */
    std::vector<std::array<unsigned int, 3>> cells{{{1, 1, 1}}};
    /** blocks: lower and upper corners of boxes that overlap in faces only. Faces
     * have the ids and names of box by their outer normal. */
    std::vector<std::pair<Point<3>, Point<3>>> blocks;
    /** blocks: region id of each; empty: all 0. */
    std::vector<int> block_regions;
    /** file, surface: paths, as written in the scene, made absolute (relative
     * ones are relative to the scene's file) by the reader. */
    std::vector<std::string> files;
    /** surface: the target edge length of CGAL's isotropic remeshing before
     * TetGen; 0: the surface is taken as it is. */
    double surface_edge_length = 0.;
    /** surface: feature edges with a dihedral angle above this many degrees are
     * kept by the remeshing. */
    double feature_angle = 60.;
    /** TetGen's bound on the volume of a tetrahedron; 0: none. */
    std::vector<double> volume_bounds{0.};
    /** Wanted edge length as an expression in x, y, z; empty: none. */
    std::string size;
    /** A size_field.vtu of an earlier run: wanted edge lengths, mapped from its
     * bounding box to that of this body; empty: none. */
    std::string size_field;
    /** New points on a curved boundary are moved to the surface of the body: */
    enum class Projection
    {
      none,
      surface,   ///< the fine triangulated surface (surface_file, or the file of source surface)
      expression ///< the zero set of one of the expressions below
    };
    Projection projection = Projection::none;
    /** surface: empty: the file of the source surface. */
    std::string projection_file;
    /** expression: functions of x, y, z; a boundary face belongs to the first that is
     * nearly zero at its three vertices. */
    std::vector<std::string> projection_functions;

    unsigned int
    n_meshes() const;
    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    /** @throws InputError naming the parameter and the cure. */
    void
    check() const;
  };

  /** How TetGen is run. */
  struct TetgenParameters
  {
    double       radius_edge_ratio   = 1.414; ///< -q; smaller is stricter; at least 1.1
    double       dihedral_angle      = 10.;   ///< -q/: smallest dihedral angle, degrees
    unsigned int optimisation_level  = 2;     ///< -O
    unsigned int optimisation_scheme = 7;     ///< -O/
    long         steiner_points      = -1;    ///< -S; -1: no cap
    bool         keep_boundary       = false; ///< -Y: no new points on the boundary
    double       time_limit          = 600.;  ///< seconds of wall time a call
    double       memory_limit        = 8192.; ///< MiB a call

    void
    declare(dealii::ParameterHandler &prm) const;
    void
    parse(dealii::ParameterHandler &prm);
    void
    check() const;
  };
} // namespace tetradapt::scene

#endif
