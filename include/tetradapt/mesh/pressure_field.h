// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_pressure_field_h
#define tetradapt_mesh_pressure_field_h

#include "tetradapt/mesh/tet_mesh.h"

#include <memory>

namespace tetradapt::mesh
{
  /**
   * Where a pressure of degree 1 has its values: at the vertices of the cells, shared by the
   * cells of one region only, since the pressure jumps where the material does. The values of
   * the region in which the cells first meet a vertex have the vertex's number; those of
   * further regions follow. The same on every rank.
   */
  class PressureNodes
  {
  public:
    explicit PressureNodes(const TetMesh &mesh);

    unsigned int
    size() const
    {
      return vertices.size();
    }
    /** The value at local vertex @p i of @p cell. */
    unsigned int
    node(unsigned int cell, unsigned int i) const
    {
      return cell_nodes[cell][i];
    }
    /** The vertex of the mesh that a value is at. */
    unsigned int
    vertex(unsigned int node) const
    {
      return vertices[node];
    }

  private:
    std::vector<std::array<unsigned int, 4>> cell_nodes;
    std::vector<unsigned int>                vertices;
  };

  /**
   * The pressure of a mixed solution: p = -(lambda - gamma) tr(eps - eps_thermal), with lambda
   * the first Lame parameter and gamma the part of it that the displacement keeps
   * (laws::PressureForm), so that with e = eps - eps_thermal the stress is
   * 2 mu e + (gamma tr e - p) I. It stays finite where lambda does not. It is linear in each cell
   * and continuous in each region. What is reported as pressure is minus a third of the stress's
   * trace.
   */
  struct PressureField
  {
    /** Zero everywhere on @p mesh. */
    explicit PressureField(const TetMesh &mesh);
    /** Zero at all of @p nodes, which are shared. */
    explicit PressureField(std::shared_ptr<const PressureNodes> nodes);

    /** Value at a point of @p cell, given in barycentric coordinates. */
    double
    value(unsigned int cell, const std::array<double, 4> &b) const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < 4; ++i)
        sum += b[i] * values[nodes->node(cell, i)];
      return sum;
    }

    std::shared_ptr<const PressureNodes> nodes;
    std::vector<double>                  values; ///< one a pressure node
  };
} // namespace tetradapt::mesh

#endif
