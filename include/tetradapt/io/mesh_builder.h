// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_mesh_builder_h
#define tetradapt_io_mesh_builder_h

#include "tetradapt/mesh/edges.h"

#include <functional>
#include <utility>

namespace tetradapt::io
{
  using dealii::Point;

  /**
   * Collects what a volume mesh file says, in the file's own order, and makes a
   * TetMesh of it that is ready for finalize(). Points come before cells.
   */
  class MeshBuilder
  {
  public:
    /** Reports an error at the place where the file is being read. */
    using Fail = std::function<void(const std::string &)>;

    explicit MeshBuilder(Fail fail) : fail(std::move(fail))
    {
    }

    std::vector<Point<3>> &
    points()
    {
      return mesh.points;
    }

    /** Adds a tetrahedron. */
    void
    add_cell(const std::array<unsigned int, 4> &vertices, int region);

    /**
     * Adds a tetrahedron with ten nodes, in the order of edge_vertices behind the
     * corners. Its edges must be straight with nodes in their middles (to 1e-6 of
     * the edge): only then can these be left out.
     */
    void
    add_quadratic_cell(const std::array<unsigned int, 10> &nodes, int region);

    /** Adds a triangle of the boundary (or inside, which finalize() drops). */
    void
    add_face(const std::array<unsigned int, 3> &vertices, int boundary_id);

    /** Names of boundary ids and regions, known before or after these. */
    void
    name_boundary(int id, const std::string &name)
    {
      boundary_names[id] = name;
    }
    void
    name_region(int id, const std::string &name)
    {
      mesh.region_names[id] = name;
    }

    std::size_t
    n_cells() const
    {
      return mesh.cells.size();
    }

    /** The mesh; the builder is empty then. Names without cells or faces are
     * left out. */
    mesh::TetMesh
    take();

  private:
    template <std::size_t n>
    void
    check(const std::array<unsigned int, n> &nodes) const;

    Fail                        fail;
    mesh::TetMesh               mesh;
    std::map<int, unsigned int> patch_of_id;
    std::map<int, std::string>  boundary_names;
  };
} // namespace tetradapt::io

#endif
