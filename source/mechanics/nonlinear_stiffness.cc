// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/nonlinear_stiffness.h"

#include "stiffness_points.h"

#include "tetradapt/core/exceptions.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>
#include <map>

namespace tetradapt::mechanics
{
  namespace
  {
    std::vector<unsigned int>
    history_sizes(const fem::Space &space, const MaterialMap &materials)
    {
      std::vector<unsigned int> sizes;
      for (const unsigned int cell : space.touching_cells())
        sizes.push_back(materials.law(space.tet_mesh().regions[cell]).n_history());
      return sizes;
    }

    const Tensor<2, 3> &
    identity()
    {
      static const Tensor<2, 3> I(dealii::unit_symmetric_tensor<3>());
      return I;
    }
  } // namespace

  /** The displacement of one cell after the other. */
  class NonlinearStiffness::Cell
  {
  public:
    Cell(const fem::Space &space, const Vector &u) : space(space), u(u)
    {
    }

    void
    enter(const unsigned int k)
    {
      cell       = space.touching_cells()[k];
      directions = mesh::barycentric_gradients(space.tet_mesh(), cell);
      nodes      = space.local_nodes_of(k);
      for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          values[i][c] = u.local_element(3 * nodes[i] + c);
      for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
        lengths[i] = values[i].norm();
    }

    /** The displacement gradient at @p b; gradients are those of the shape functions after it. */
    Tensor<2, 3>
    gradient(const mesh::Barycentric &b)
    {
      mesh::shape_gradients(space.degree(), b, directions, gradients.data());
      Tensor<2, 3> G;
      for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
        G += outer_product(values[i], gradients[i]);
      return G;
    }

    /** The smallest determinant at the vertices. */
    double
    least_at_vertices()
    {
      double least = std::numeric_limits<double>::max();
      for (unsigned int v = 0; v < 4; ++v)
        {
          mesh::Barycentric b{};
          b[v]           = 1.;
          const double J = determinant(identity() + gradient(b));
          least = std::isfinite(J) ? std::min(least, J) : std::numeric_limits<double>::lowest();
        }
      return least;
    }

    /** Whether this rank counts the cell, in sums over all ranks. */
    bool
    is_mine() const
    {
      return nodes[0] < space.n_owned_nodes();
    }

    const fem::Space            &space;
    const Vector                &u;
    unsigned int                 cell  = 0;
    const unsigned int          *nodes = nullptr; ///< local ones
    std::array<Tensor<1, 3>, 4>  directions;
    std::array<Tensor<1, 3>, 10> values, gradients;
    std::array<double, 10>       lengths; ///< of values
  };

  NonlinearStiffness::NonlinearStiffness(const fem::Space &space, const MaterialMap &materials)
    : space(space), materials(materials), points(stiffness_points(space.degree())),
      history(history_sizes(space, materials), points.size())
  {
  }

  Deformed
  NonlinearStiffness::internal_forces(const Vector &u, Vector &forces) const
  {
    namespace MPI = dealii::Utilities::MPI;
    u.update_ghost_values();
    forces.reinit(space.vector_layout());
    Cell                  cell(space, u);
    Deformed              result;
    laws::Response        response;
    const auto           &mesh  = space.tet_mesh();
    bool                  right = true;
    std::vector<double>   rounding(space.n_owned_nodes(), 0.);
    std::map<int, double> moduli;
    result.least_jacobian = std::numeric_limits<double>::max();
    for (unsigned int k = 0; k < space.touching_cells().size(); ++k)
      {
        cell.enter(k);
        const auto  &law     = materials.law(mesh.regions[cell.cell]);
        const double weight  = mesh::cell_volume(mesh, cell.cell) / points.size();
        double      &modulus = moduli[mesh.regions[cell.cell]];
        if (modulus == 0.)
          modulus = law.tangent_at_rest()[0][0][0][0];
        double least
          = space.degree() == 1 ? std::numeric_limits<double>::max() : cell.least_at_vertices();
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            const Tensor<2, 3> G = cell.gradient(points[q]);
            const double       J = determinant(identity() + G);
            least = std::isfinite(J) ? std::min(least, J) : std::numeric_limits<double>::lowest();
            if (!law.update(G, history.at(k, q), false, response))
              {
                right = false;
                continue;
              }
            if (cell.is_mine())
              result.stored_energy += weight * response.energy;
            // Gradients are sums of values that may be alike.
            double parts = 0.;
            for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
              parts += cell.lengths[i] * cell.gradients[i].norm();
            const double unsure = weight * (response.stress.norm() + modulus * parts);
            for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
              if (cell.nodes[i] < space.n_owned_nodes())
                {
                  const Tensor<1, 3> force = weight * (response.stress * cell.gradients[i]);
                  rounding[cell.nodes[i]] += unsure * cell.gradients[i].norm();
                  for (unsigned int c = 0; c < 3; ++c)
                    forces.local_element(3 * cell.nodes[i] + c) += force[c];
                }
          }
        right = right && (least > 0. || law.supports(laws::Formulation::displacement));
        if (least < result.least_jacobian)
          {
            result.least_jacobian = least;
            result.worst_place    = mesh.points[mesh.cells[cell.cell][0]];
            for (unsigned int i = 1; i < 4; ++i)
              result.worst_place
                += (mesh.points[mesh.cells[cell.cell][i]] - result.worst_place) / (i + 1.);
          }
      }
    u.zero_out_ghost_values();
    const MPI_Comm communicator = space.communicator();
    result.is_admissible        = MPI::min(right ? 1 : 0, communicator) == 1;
    result.stored_energy        = MPI::sum(result.stored_energy, communicator);
    double square               = 0.;
    for (const double value : rounding)
      square += value * value;
    result.force_rounding
      = std::numeric_limits<double>::epsilon() * std::sqrt(MPI::sum(square, communicator));
    // The place from the rank that has the smallest; the first of several.
    const auto least      = MPI::min_max_avg(result.least_jacobian, communicator);
    result.least_jacobian = least.min;
    double place[3]       = {result.worst_place[0], result.worst_place[1], result.worst_place[2]};
    MPI_Bcast(place, 3, MPI_DOUBLE, static_cast<int>(least.min_index), communicator);
    result.worst_place = dealii::Point<3>(place[0], place[1], place[2]);
    return result;
  }

  TangentField
  NonlinearStiffness::linearise(const Vector &u) const
  {
    u.update_ghost_values();
    const auto                &mesh = space.tet_mesh();
    const std::size_t          n    = space.touching_cells().size();
    std::vector<laws::Tangent> tangents(n * points.size());
    std::vector<unsigned int>  first(mesh.n_cells(), dealii::numbers::invalid_unsigned_int);
    Cell                       cell(space, u);
    laws::Response             response;
    const std::string         *without = nullptr; ///< a material that has none
    for (unsigned int k = 0; k < n; ++k)
      {
        cell.enter(k);
        first[cell.cell] = k * points.size();
        const auto &law  = materials.law(mesh.regions[cell.cell]);
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            if (!law.update(cell.gradient(points[q]), history.at(k, q), true, response))
              without = &materials.parameters(mesh.regions[cell.cell]).name;
            tangents[k * points.size() + q] = response.tangent;
          }
      }
    u.zero_out_ghost_values();
    if (dealii::Utilities::MPI::max(without != nullptr ? 1 : 0, space.communicator()) > 0)
      throw core::NumericalError("A material" + (without == nullptr ? "" : " ('" + *without + "')")
                                 + " has no tangent at a deformation of the body.");
    return TangentField(std::move(tangents), std::move(first), points.size());
  }

  void
  NonlinearStiffness::accept()
  {
    history.accept();
  }
} // namespace tetradapt::mechanics
