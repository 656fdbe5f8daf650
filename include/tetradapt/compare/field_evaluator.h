// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_field_evaluator_h
#define tetradapt_compare_field_evaluator_h

#include "tetradapt/mesh/nodal_field.h"

namespace tetradapt::compare
{
  using dealii::Point;
  using dealii::Tensor;

  /**
   * Values and gradients of a field at very many points. The gradient of a field
   * of degree 1 is constant in a cell, that of degree 2 is linear: it is computed
   * once at each cell's vertices (72 or 288 bytes a cell), after which a point
   * costs some ten or forty operations.
   */
  class FieldEvaluator
  {
  public:
    /** Keeps a reference to @p field, which must not change afterwards. */
    explicit FieldEvaluator(const mesh::NodalField &field);

    const mesh::NodalField &
    field() const
    {
      return nodal_field;
    }

    Tensor<1, 3>
    value(const unsigned int cell, const mesh::Barycentric &b) const
    {
      Tensor<1, 3> sum;
      const auto  &vertices = nodal_field.mesh().cells[cell];
      if (linear)
        {
          for (unsigned int i = 0; i < 4; ++i)
            sum += b[i] * nodal_field.values[vertices[i]];
          return sum;
        }
      double shape[10];
      mesh::shape_values(2, b, shape);
      const unsigned int n_points = nodal_field.mesh().n_points();
      for (unsigned int i = 0; i < 4; ++i)
        sum += shape[i] * nodal_field.values[vertices[i]];
      for (unsigned int e = 0; e < 6; ++e)
        sum
          += shape[4 + e] * nodal_field.values[n_points + nodal_field.edges().cell_edges[cell][e]];
      return sum;
    }

    /** du_i/dx_j at a point of @p cell. */
    Tensor<2, 3>
    gradient(const unsigned int cell, const mesh::Barycentric &b) const
    {
      if (linear)
        return gradients[cell];
      Tensor<2, 3> sum;
      for (unsigned int i = 0; i < 4; ++i)
        sum += b[i] * gradients[4 * std::size_t(cell) + i];
      return sum;
    }

    /** The pressure of a solution in mixed form, else zero. */
    double
    pressure(const unsigned int cell, const mesh::Barycentric &b) const
    {
      return nodal_field.pressure ? nodal_field.pressure->value(cell, b) : 0.;
    }

  private:
    const mesh::NodalField   &nodal_field;
    bool                      linear;
    std::vector<Tensor<2, 3>> gradients; ///< one a cell, or four: at its vertices
  };

  /** Gradients of @p field, of degree 2, at the four vertices of @p cell. */
  std::array<Tensor<2, 3>, 4>
  vertex_gradients(const mesh::NodalField &field, unsigned int cell);

  /** The position of a point given in barycentric coordinates. */
  inline Point<3>
  position(const mesh::TetMesh &mesh, const unsigned int cell, const mesh::Barycentric &b)
  {
    const auto &v = mesh.cells[cell];
    Point<3>    p;
    for (unsigned int d = 0; d < 3; ++d)
      p[d] = b[0] * mesh.points[v[0]][d] + b[1] * mesh.points[v[1]][d] + b[2] * mesh.points[v[2]][d]
             + b[3] * mesh.points[v[3]][d];
    return p;
  }
} // namespace tetradapt::compare

#endif
