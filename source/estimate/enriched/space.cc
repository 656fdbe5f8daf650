// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/enriched/space.h"

#include "cell_batches.h"

#include "tetradapt/compare/parallel.h"
#include "tetradapt/mechanics/supports.h"

#include <algorithm>

namespace tetradapt::estimate
{
  struct EnrichedSpace::Batches : CellBatches
  {
    using CellBatches::CellBatches;
  };

  EnrichedSpace::EnrichedSpace(const mesh::NodalField       &field,
                               const mechanics::MaterialMap &materials,
                               MPI_Comm                      communicator,
                               const mechanics::Springs     *springs_on_mesh)
    : springs(springs_on_mesh != nullptr && !springs_on_mesh->empty() ? springs_on_mesh : nullptr),
      mpi_communicator(communicator), hierarchical_surplus(field), n_field_nodes(field.n_nodes()),
      batches(std::make_unique<Batches>(hierarchical_surplus,
                                        n_field_nodes,
                                        materials,
                                        compare::own_slice(field.mesh().n_cells(), communicator)))
  {
    if (springs == nullptr)
      return;
    face_nodes = mechanics::boundary_face_nodes(field.mesh(),
                                                field.degree() == 1 ? nullptr : &field.edges());
    springs_matrix.emplace(*springs, face_functions(), n_functions());
  }

  mechanics::FaceFunctions
  EnrichedSpace::face_functions() const
  {
    const HierarchicalSurplus &surplus = hierarchical_surplus;
    const unsigned int         degree = surplus.degree(), n_nodes = degree == 1 ? 3 : 6;
    // Of the cell's functions of the surplus, those on a face.
    const auto on_face = [degree](const unsigned int local, const auto &visit) {
      for (unsigned int e = 0; e < 6; ++e)
        if (mesh::edge_vertices[e][0] != local && mesh::edge_vertices[e][1] != local)
          visit(e);
      if (degree == 2)
        visit(6 + local);
    };
    mechanics::FaceFunctions functions;
    functions.n_per_face = degree == 1 ? 6 : 10;
    functions.numbers    = [&, n_nodes, on_face](const unsigned int face, unsigned int *numbers) {
      std::copy_n(face_nodes[face].begin(), n_nodes, numbers);
      const unsigned int slot = surplus.faces().boundary_slots[face];
      unsigned int       i    = n_nodes;
      on_face(slot % 4, [&](const unsigned int f) {
        numbers[i++] = n_field_nodes + surplus.function(slot / 4, f);
      });
    };
    functions.values = [&, degree, n_nodes, on_face](const unsigned int           face,
                                                     const std::array<double, 3> &b,
                                                     double                      *values) {
      mechanics::face_shape_values(degree, b, values);
      const unsigned int   slot = surplus.faces().boundary_slots[face];
      const mesh::TetMesh &mesh = surplus.mesh();
      mesh::Barycentric    in_cell{{0., 0., 0., 0.}};
      for (unsigned int v = 0; v < 4; ++v)
        for (unsigned int k = 0; k < 3; ++k)
          if (mesh.cells[slot / 4][v] == mesh.faces[face].vertices[k])
            in_cell[v] = b[k];
      double all[HierarchicalSurplus::max_per_cell];
      HierarchicalSurplus::values(degree, in_cell, all);
      const auto   signs = surplus.signs(slot / 4);
      unsigned int i     = n_nodes;
      on_face(slot % 4, [&](const unsigned int f) { values[i++] = signs[f] * all[f]; });
    };
    return functions;
  }

  EnrichedSpace::~EnrichedSpace() = default;

  EnrichedSpace::Values
  EnrichedSpace::embed(const std::vector<Tensor<1, 3>> &nodal_values) const
  {
    Values result(size());
    for (unsigned int i = 0; i < n_field_nodes; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        result[3 * i + c] = nodal_values[i][c];
    return result;
  }

  void
  EnrichedSpace::multiply(const Values &x, Values &forces) const
  {
    forces.reinit(size());
    multiply_batches(*batches, x.data(), forces.data());
    if (springs_matrix)
      {
        const auto own = compare::own_slice(springs_matrix->rows().size(), mpi_communicator);
        springs_matrix->add_product(x.data(), forces.data(), own.begin, own.end);
      }
    compare::sum_over_ranks(forces.data(), forces.size(), mpi_communicator);
  }

  std::vector<double>
  EnrichedSpace::cell_products(const Values &x, const Values &y) const
  {
    const unsigned int  n_cells = hierarchical_surplus.mesh().n_cells();
    std::vector<double> products(n_cells, 0.);
    batch_products(*batches, x.data(), y.data(), products.data());
    compare::gather_slices(products, n_cells, 1, mpi_communicator);
    return products;
  }

  std::vector<double>
  EnrichedSpace::surplus_diagonal() const
  {
    std::vector<double> diagonal(9 * static_cast<std::size_t>(hierarchical_surplus.n_functions()),
                                 0.);
    add_surplus_diagonal(*batches, n_field_nodes, diagonal.data());
    compare::sum_over_ranks(diagonal, mpi_communicator);
    for (std::size_t k = 0; springs_matrix && k < springs_matrix->rows().size(); ++k)
      if (springs_matrix->rows()[k] >= n_field_nodes)
        for (unsigned int i = 0; i < 9; ++i)
          diagonal[9 * std::size_t(springs_matrix->rows()[k] - n_field_nodes) + i]
            += springs_matrix->diagonal(k)[i];
    return diagonal;
  }

  void
  EnrichedSpace::add_spring_products(const Values        &x,
                                     const Values        &y,
                                     std::vector<double> &products) const
  {
    if (springs == nullptr)
      return;
    const mechanics::FaceFunctions functions = face_functions();
    unsigned int                   numbers[mechanics::FaceFunctions::most];
    double                         values[mechanics::FaceFunctions::most];
    for (const mechanics::Springs::Face &face : springs->faces())
      {
        functions.numbers(face.face, numbers);
        double &sum = products[hierarchical_surplus.faces().boundary_slots[face.face] / 4];
        for (const mechanics::Springs::Sample &point : face.points)
          {
            functions.values(face.face, point.b, values);
            Tensor<1, 3> at[2];
            for (unsigned int i = 0; i < functions.n_per_face; ++i)
              for (unsigned int c = 0; c < 3; ++c)
                {
                  at[0][c] += values[i] * x[3 * std::size_t(numbers[i]) + c];
                  at[1][c] += values[i] * y[3 * std::size_t(numbers[i]) + c];
                }
            sum += point.weight * (at[0] * (point.stiffness * at[1]));
          }
      }
  }

  EnrichedSpace::Values
  EnrichedSpace::ground_forces() const
  {
    Values forces(size());
    if (springs == nullptr || !springs->have_moved_ground())
      return forces;
    const mechanics::FaceFunctions functions = face_functions();
    unsigned int                   numbers[mechanics::FaceFunctions::most];
    double                         values[mechanics::FaceFunctions::most];
    for (const mechanics::Springs::Face &face : springs->faces())
      {
        functions.numbers(face.face, numbers);
        for (const mechanics::Springs::Sample &point : face.points)
          {
            functions.values(face.face, point.b, values);
            const Tensor<1, 3> force = point.weight * (point.stiffness * point.ground);
            for (unsigned int i = 0; i < functions.n_per_face; ++i)
              for (unsigned int c = 0; c < 3; ++c)
                forces[3 * std::size_t(numbers[i]) + c] += values[i] * force[c];
          }
      }
    return forces;
  }
} // namespace tetradapt::estimate
