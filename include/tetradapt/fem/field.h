// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_fem_field_h
#define tetradapt_fem_field_h

#include "tetradapt/fem/pressure_space.h"

#include <array>

namespace tetradapt::fem
{
  /**
   * The pressure of a mixed solution (what it is says mesh::PressureField), distributed over the
   * ranks: each has the values at its own nodes and, as ghosts, at those of its
   * Space::touching_cells(). It does not change, and is shared instead of copied.
   */
  class Pressure
  {
  public:
    /** Takes the owned entries of @p values, which has the space's layout. Collective: fetches
     * ghosts. */
    Pressure(std::shared_ptr<const PressureSpace> space, Vector values);
    Pressure(const Pressure &) = delete;
    Pressure &
    operator=(const Pressure &)
      = delete;

    const PressureSpace &
    space() const
    {
      return *pressure_space;
    }
    const std::shared_ptr<const PressureSpace> &
    shared_space() const
    {
      return pressure_space;
    }
    /** With ghost values. */
    const Vector &
    vector() const
    {
      return values;
    }
    /** Value at a point of mesh cell @p cell, one of the touching cells, in barycentric
     * coordinates. */
    double
    value(const unsigned int cell, const std::array<double, 4> &b) const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < 4; ++i)
        sum += b[i] * values.local_element(pressure_space->cell_node(cell, i));
      return sum;
    }

  private:
    std::shared_ptr<const PressureSpace> pressure_space;
    Vector                               values;
  };

  /**
   * A displacement of a Space, distributed over the ranks: each has the values at its own nodes
   * and, as ghosts, at those of its Space::touching_cells(). In mixed form the pressure belongs
   * to it. It shares the space, and so the triangulation and the mesh, and outlives the system
   * that it solves. It does not change, and is shared instead of copied.
   */
  class Field
  {
  public:
    /** Zero everywhere, without a pressure. */
    explicit Field(std::shared_ptr<const Space> space);

    /** Takes the owned entries of @p values, which has the space's layout. Collective: fetches
     * ghosts. @param pressure null in displacement form. */
    Field(std::shared_ptr<const Space>    space,
          Vector                          values,
          std::shared_ptr<const Pressure> pressure = nullptr);
    Field(const Field &) = delete;
    Field &
    operator=(const Field &)
      = delete;

    const Space &
    space() const
    {
      return *field_space;
    }
    const std::shared_ptr<const Space> &
    shared_space() const
    {
      return field_space;
    }
    const mesh::TetMesh &
    mesh() const
    {
      return field_space->tet_mesh();
    }
    unsigned int
    degree() const
    {
      return field_space->degree();
    }
    /** Components of all local nodes, with ghost values. */
    const Vector &
    vector() const
    {
      return values;
    }
    /** The displacement at a local node, owned or ghost. */
    dealii::Tensor<1, 3>
    value(const unsigned int local_node) const
    {
      dealii::Tensor<1, 3> u;
      for (unsigned int c = 0; c < 3; ++c)
        u[c] = values.local_element(3 * local_node + c);
      return u;
    }
    /** The displacements of the nodes of the k-th of Space::touching_cells(), in the first 4 or 10
     * entries. */
    void
    values_of_cell(const unsigned int k, std::array<dealii::Tensor<1, 3>, 10> &result) const
    {
      const unsigned int *nodes = field_space->local_nodes_of(k);
      for (unsigned int i = 0; i < field_space->n_nodes_per_cell(); ++i)
        result[i] = value(nodes[i]);
    }
    /** Null in displacement form. */
    const std::shared_ptr<const Pressure> &
    pressure() const
    {
      return pressure_pointer;
    }

    /** The largest length of a displacement at a node, of all ranks. Collective. */
    double
    largest_norm() const;

  private:
    std::shared_ptr<const Space>    field_space;
    Vector                          values;
    std::shared_ptr<const Pressure> pressure_pointer;
  };
} // namespace tetradapt::fem

#endif
