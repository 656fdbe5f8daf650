// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_nodal_field_h
#define tetradapt_mesh_nodal_field_h

#include "tetradapt/mesh/edges.h"
#include "tetradapt/mesh/pressure_field.h"

#include <memory>

namespace tetradapt::mesh
{
  /** Barycentric coordinates in a tetrahedron; they sum to one. */
  using Barycentric = std::array<double, 4>;

  /**
   * A continuous, piecewise polynomial vector field (a displacement) on a
   * TetMesh, of Lagrange degree 1 or 2. Nodes are numbered: first the points of
   * the mesh, then, for degree 2, one node in the middle of every edge in the
   * order of the edge table. Every MPI rank holds the whole field.
   */
  class NodalField
  {
  public:
    /** A zero field. Shares ownership of the mesh and, for degree 2, makes or
     * shares the edge table. */
    NodalField(std::shared_ptr<const TetMesh>   mesh,
               unsigned int                     degree,
               std::shared_ptr<const EdgeTable> edges = nullptr);

    const TetMesh &
    mesh() const
    {
      return *mesh_pointer;
    }
    std::shared_ptr<const TetMesh>
    shared_mesh() const
    {
      return mesh_pointer;
    }
    /** Only for degree 2. */
    const EdgeTable &
    edges() const
    {
      return *edge_pointer;
    }
    std::shared_ptr<const EdgeTable>
    shared_edges() const
    {
      return edge_pointer;
    }
    unsigned int
    degree() const
    {
      return polynomial_degree;
    }
    unsigned int
    n_nodes() const
    {
      return values.size();
    }
    /** 4 or 10. */
    unsigned int
    n_nodes_per_cell() const
    {
      return polynomial_degree == 1 ? 4 : 10;
    }
    /** Global node number of local node @p i (vertices, then edges) of @p cell. */
    unsigned int
    node(unsigned int cell, unsigned int i) const
    {
      return i < 4 ? mesh_pointer->cells[cell][i]
                   : mesh_pointer->n_points() + edge_pointer->cell_edges[cell][i - 4];
    }
    /** Rest position of node @p n. */
    Point<3>
    node_position(unsigned int n) const;

    /** Field value at a point of @p cell. */
    Tensor<1, 3>
    value(unsigned int cell, const Barycentric &b) const;

    /** Displacement gradient du_i/dx_j at a point of @p cell. */
    Tensor<2, 3>
    gradient(unsigned int cell, const Barycentric &b) const;

    /** One displacement a node. */
    std::vector<Tensor<1, 3>> values;

    /** The pressure that belongs to a displacement solved for in mixed form; null for one in
     * displacement form, whose strain says all. */
    std::shared_ptr<const PressureField> pressure;

  private:
    std::shared_ptr<const TetMesh>   mesh_pointer;
    std::shared_ptr<const EdgeTable> edge_pointer;
    unsigned int                     polynomial_degree;
  };

  /** Gradients of the four barycentric coordinates of a cell (constant). */
  std::array<Tensor<1, 3>, 4>
  barycentric_gradients(const TetMesh &mesh, unsigned int cell);

  /** Barycentric coordinates of @p p with respect to @p cell (any sign). */
  Barycentric
  barycentric_coordinates(const TetMesh &mesh, unsigned int cell, const Point<3> &p);

  /** Values of the 4 or 10 Lagrange shape functions at @p b. */
  void
  shape_values(unsigned int degree, const Barycentric &b, double *values);

  /** Gradients of the 4 or 10 shape functions at @p b, given the gradients of
   * the barycentric coordinates. */
  void
  shape_gradients(unsigned int                       degree,
                  const Barycentric                 &b,
                  const std::array<Tensor<1, 3>, 4> &barycentric_gradients,
                  Tensor<1, 3>                      *gradients);
} // namespace tetradapt::mesh

#endif
