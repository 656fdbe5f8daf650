// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_tet_mesh_h
#define tetradapt_mesh_tet_mesh_h

#include <deal.II/base/point.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace tetradapt::mesh
{
  using dealii::Point;
  using dealii::Tensor;

  /**
   * A set of boundary faces that is treated alike: one boundary id of the input
   * and one combination of the scene's selections. Faces that TetGen makes by
   * splitting a face belong to the patch of the face they were made from, so a
   * support or a load that was put on a patch survives remeshing exactly.
   */
  struct Patch
  {
    int                      boundary_id = 0; ///< id in the input mesh
    std::string              name;            ///< named group, may be empty
    std::vector<std::string> selections;      ///< names of supports and loads that hold here
  };

  /**
   * A point or a straight line of the scene where a support or a load acts: the mesh has a
   * vertex there, or edges along the whole line. Meshes that are made from a mesh keep its places.
   */
  struct KeptPlace
  {
    std::string           name; ///< of the support or load: "Supports/hinge"
    std::vector<Point<3>> ends; ///< one: a vertex; two: the vertices at the ends of a line

    bool
    is_line() const
    {
      return ends.size() == 2;
    }
  };

  /** A triangle of the boundary. */
  struct BoundaryFace
  {
    std::array<unsigned int, 3> vertices;  ///< point numbers; see finalize()
    unsigned int                patch = 0; ///< index into TetMesh::patches
  };

  /**
   * A tetrahedral mesh as plain data: readers, TetGen, writers, locators and
   * estimators share it, and none of them needs a deal.II triangulation.
   *
   * Invariants after finalize() (see finalize.h): every cell has positive
   * volume, i.e. (p1-p0)x(p2-p0).(p3-p0) > 0; faces holds each boundary triangle
   * exactly once, its vertices counter-clockwise seen from outside; every face
   * and cell refers to an existing patch or region.
   */
  struct TetMesh
  {
    std::vector<Point<3>>                    points;
    std::vector<std::array<unsigned int, 4>> cells;   ///< four point numbers
    std::vector<int>                         regions; ///< one id a cell
    std::vector<BoundaryFace>                faces;
    std::vector<Patch>                       patches;
    std::map<int, std::string>               region_names;
    std::vector<KeptPlace>                   kept; ///< points and lines that have vertices

    unsigned int
    n_points() const
    {
      return points.size();
    }
    unsigned int
    n_cells() const
    {
      return cells.size();
    }
  };

  /** Signed volume of cell @p cell, in the cube of the mesh's length unit. */
  double
  cell_volume(const TetMesh &mesh, unsigned int cell);

  /** Sum of all cell volumes. */
  double
  total_volume(const TetMesh &mesh);

  /** Normal of a face, as long as its area is large; it points out of the body
   * once finalize() has turned the face. */
  Tensor<1, 3>
  face_area_vector(const TetMesh &mesh, const BoundaryFace &face);

  /** Smallest axis-parallel box around the points: lower and upper corner. */
  std::pair<Point<3>, Point<3>>
  bounding_box(const TetMesh &mesh);
} // namespace tetradapt::mesh

#endif
