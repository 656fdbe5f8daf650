// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Distributed displacements and pressures: ghosts are up to date, cells are counted once, a field
// keeps what it stands on, and the adaptor to values that every rank holds gives them back bit by
// bit. Also where ranks have no cells.

#include "tetradapt/fem/replication.h"
#include "tetradapt/fem/triangulation.h"

#include "../mechanics/bodies.h"

#include <deal.II/base/mpi.h>

using namespace bodies;

namespace
{
  bool is_first_rank = false;

  /** As bodies::check(), for a fact that must hold on every rank. */
  void
  check_everywhere(const std::string &what, const bool holds)
  {
    const bool all = dealii::Utilities::MPI::min(holds ? 1 : 0, MPI_COMM_WORLD) == 1;
    if (is_first_rank)
      check(what, all);
  }

  Tensor<1, 3>
  displacement(const Point<3> &x)
  {
    return Tensor<1, 3>({std::sin(x[0]), x[1] * x[2] - 2., std::cos(x[0] + x[2])});
  }

  /** It jumps between regions. */
  double
  pressure(const Point<3> &x, const int region)
  {
    return x[0] - 3. * x[1] + 0.5 * x[2] + 7. * region;
  }

  std::shared_ptr<const fem::Pressure>
  make_pressure(const std::shared_ptr<const fem::Space> &space)
  {
    const mesh::TetMesh &body  = space->tet_mesh();
    const auto           nodes = std::make_shared<const mesh::PressureNodes>(body);
    std::vector<int>     regions(nodes->size());
    for (unsigned int cell = 0; cell < body.n_cells(); ++cell)
      for (unsigned int i = 0; i < 4; ++i)
        regions[nodes->node(cell, i)] = body.regions[cell];
    const auto  pressures = std::make_shared<const fem::PressureSpace>(space, nodes);
    fem::Vector values(pressures->vector_layout());
    for (unsigned int node = 0; node < pressures->n_owned_nodes(); ++node)
      {
        const unsigned int field_node = pressures->field_node(node);
        values.local_element(node)
          = pressure(body.points[nodes->vertex(field_node)], regions[field_node]);
      }
    return std::make_shared<const fem::Pressure>(pressures, std::move(values));
  }

  /** What it is made from does not outlive this call. */
  std::shared_ptr<const fem::Field>
  make_field(const mesh::TetMesh &body, const unsigned int degree)
  {
    const auto space = std::make_shared<const fem::Space>(
      std::make_shared<const fem::Triangulation>(std::make_shared<const mesh::TetMesh>(body),
                                                 MPI_COMM_WORLD),
      degree);
    fem::Vector values(space->vector_layout());
    for (unsigned int node = 0; node < space->n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        values.local_element(3 * node + c) = displacement(space->node_position(node))[c];
    return std::make_shared<const fem::Field>(space,
                                              std::move(values),
                                              degree == 2 ? make_pressure(space) : nullptr);
  }

  bool
  same(const fem::Vector &a, const fem::Vector &b)
  {
    bool result = a.locally_owned_size() == b.locally_owned_size();
    for (unsigned int i = 0; result && i < a.locally_owned_size(); ++i)
      result = a.local_element(i) == b.local_element(i);
    return result;
  }

  void
  check_cells(const fem::Field &field)
  {
    const fem::Space            &space = field.space();
    const mesh::TetMesh         &body  = space.tet_mesh();
    const mesh::Barycentric      point{{0.1, 0.2, 0.3, 0.4}};
    std::array<Tensor<1, 3>, 10> values;
    double                       volume = 0., worst = 0.;
    bool                         right = true;
    for (unsigned int k = 0; k < space.touching_cells().size(); ++k)
      {
        const unsigned int cell = space.touching_cells()[k];
        field.values_of_cell(k, values);
        for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
          right
            = right && values[i] == displacement(space.node_position(space.local_nodes_of(k)[i]));
        if (space.is_own_cell(k))
          volume += mesh::cell_volume(body, cell);
        if (!field.pressure())
          continue;
        Point<3> x;
        for (unsigned int i = 0; i < 4; ++i)
          x += point[i] * Tensor<1, 3>(body.points[body.cells[cell][i]]);
        worst = std::max(worst,
                         std::abs(field.pressure()->value(cell, point)
                                  - pressure(x, body.regions[cell])));
      }
    check_everywhere("  values in all cells of a rank", right);
    volume = dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD);
    check_everywhere("  each cell is the own one of one rank",
                     std::abs(volume / mesh::total_volume(body) - 1.) < 1e-12);
    if (field.pressure())
      check_everywhere("  pressures in all cells of a rank", worst < 1e-12);
  }

  void
  check_adaptor(const fem::Field &field)
  {
    const auto whole = fem::replicate(field);
    bool       right = whole->degree() == field.degree() && &whole->mesh() == &field.mesh();
    double     norm  = 0.;
    for (unsigned int node = 0; node < whole->n_nodes(); ++node)
      {
        // The middles of edges are computed in two ways.
        right = right
                && (whole->values[node] - displacement(whole->node_position(node))).norm() < 1e-13;
        norm = std::max(norm, whole->values[node].norm());
      }
    check_everywhere("  replicated", right);
    check_everywhere("  largest norm", std::abs(field.largest_norm() - norm) < 1e-14 * norm);
    const fem::Vector of_values = fem::distribute(field.space(), whole->values);
    check_everywhere("  distributed again: values", same(of_values, field.vector()));
    for (const auto &again :
         {fem::distribute(*whole, field.shared_space()), fem::distribute(*whole, MPI_COMM_WORLD)})
      {
        check_everywhere("  distributed again", same(again->vector(), field.vector()));
        check_cells(*again);
        if (field.pressure())
          check_everywhere("  and its pressure",
                           same(again->pressure()->vector(), field.pressure()->vector())
                             && fem::replicate(*again)->pressure->values
                                  == whole->pressure->values);
      }
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  is_first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

  const auto bricks = box(Point<3>(3, 1, 1), {{7, 3, 3}}, 0.3, 1.5);
  // More ranks than cells.
  mesh::TetMesh one_cell;
  one_cell.points  = {Point<3>(), Point<3>(1, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)};
  one_cell.cells   = {{{0, 1, 2, 3}}};
  one_cell.regions = {0};
  mesh::finalize(one_cell, "one cell");
  for (const mesh::TetMesh *body : std::vector<const mesh::TetMesh *>{bricks.get(), &one_cell})
    for (const unsigned int degree : {1, 2})
      {
        if (is_first_rank)
          std::cout << "--- " << body->n_cells() << " cells, degree " << degree << '\n';
        const auto field = make_field(*body, degree);
        check_cells(*field);
        check_adaptor(*field);
        check_everywhere("  zero", fem::Field(field->shared_space()).largest_norm() == 0.);
      }
}
