// SPDX-License-Identifier: AGPL-3.0-or-later
//
// deal.II's triangulation and DoFHandler of a mesh hold what the mesh holds, whatever the number
// of ranks, also where ranks have no cells: volume, regions, patches, and the tables of local
// numbers agree with the handler's. The handler numbers nodes in the order in which cells name
// them.

#include "tetradapt/fem/replication.h"
#include "tetradapt/fem/triangulation.h"

#include "../mechanics/bodies.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/dofs/dof_handler.h>

#include <map>

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

  void
  check_sum(const std::string &what, const double part, const double exact)
  {
    const double sum = dealii::Utilities::MPI::sum(part, MPI_COMM_WORLD);
    if (is_first_rank)
      check(what, sum, exact, std::abs(exact) + 1., 1e-12);
  }

  void
  check_triangulation(const mesh::TetMesh &body, const fem::Triangulation &triangulation)
  {
    check_everywhere("number of cells", triangulation.n_global_active_cells() == body.n_cells());
    double                volume = 0.;
    bool                  alike  = true;
    std::map<int, double> of_patches; // areas
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        const unsigned int k = triangulation.mesh_cell(cell->index());
        alike                = alike && int(cell->material_id()) == body.regions[k];
        for (unsigned int v = 0; v < 4; ++v)
          alike = alike && cell->vertex(v) == body.points[body.cells[k][v]];
        if (!cell->is_locally_owned())
          continue;
        volume += cell->measure();
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f))
            of_patches[cell->face(f)->boundary_id()] += cell->face(f)->measure();
      }
    check_everywhere("cells' points and regions", alike);
    check_sum("volume", volume, mesh::total_volume(body));
    check_sum("area without a patch", of_patches[0], 0.);
    for (unsigned int p = 0; p < body.patches.size(); ++p)
      {
        double area = 0.;
        for (const auto &face : body.faces)
          if (face.patch == p)
            area += mesh::face_area_vector(body, face).norm();
        check_sum("area of patch " + std::to_string(p), of_patches[p + 1], area);
      }
  }

  /** A linear_part() is the space of degree 1, but for its handler. */
  void
  check_linear_part(const fem::Space &quadratic)
  {
    const auto       part = fem::Space::linear_part(quadratic);
    const fem::Space whole(quadratic.shared_triangulation(), 1);
    bool             same = part->touching_cells() == whole.touching_cells()
                && part->n_owned_nodes() == whole.n_owned_nodes()
                && part->n_local_nodes() == whole.n_local_nodes()
                && part->n_dofs() == whole.n_dofs();
    for (unsigned int k = 0; same && k < whole.touching_cells().size(); ++k)
      for (unsigned int i = 0; i < 4; ++i)
        same = same && part->local_nodes_of(k)[i] == whole.local_nodes_of(k)[i];
    for (unsigned int node = 0; same && node < whole.n_local_nodes(); ++node)
      same = part->field_node(node) == whole.field_node(node)
             && part->vector_layout()->local_to_global(3 * node)
                  == whole.vector_layout()->local_to_global(3 * node);
    check_everywhere("  its linear part is the space of degree 1", same);
  }

  void
  check_space(const std::shared_ptr<const fem::Triangulation> &triangulation,
              const unsigned int                               degree)
  {
    using dealii::types::global_dof_index;
    const fem::Space   space(triangulation, degree);
    const unsigned int n_nodes = space.n_nodes_per_cell();

    // Every rank numbers all nodes.
    std::vector<global_dof_index> numbers(space.n_field_nodes(),
                                          dealii::numbers::invalid_dof_index);
    global_dof_index              next = 0;
    for (const unsigned int cell : triangulation->partition().order())
      for (unsigned int i = 0; i < n_nodes; ++i)
        if (auto &number = numbers[space.cell_node(cell, i)];
            number == dealii::numbers::invalid_dof_index)
          number = next++;
    check_everywhere("degree " + std::to_string(degree) + ": number of unknowns",
                     space.n_dofs() == 3 * next);

    bool                          in_order = true, tables = true, ghosts = true;
    std::vector<global_dof_index> dofs(3 * n_nodes);
    unsigned int                  k = 0;
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        const unsigned int mesh_cell = triangulation->mesh_cell(cell->index());
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < 3 * n_nodes; ++i)
          in_order = in_order && dofs[i] == 3 * numbers[space.cell_node(mesh_cell, i / 3)] + i % 3;
        if (k == space.touching_cells().size() || space.touching_cells()[k] != mesh_cell)
          {
            ghosts = ghosts && cell->is_ghost();
            continue;
          }
        for (unsigned int i = 0; i < n_nodes; ++i)
          {
            const unsigned int local = space.local_nodes_of(k)[i];
            const unsigned int field = space.cell_node(mesh_cell, i);
            tables = tables && space.field_node(local) == field && space.local_node(field) == local
                     && space.vector_layout()->local_to_global(3 * local) == dofs[3 * i];
          }
        ++k;
      }
    check_everywhere("  deal.II's numbers are in the order of the cells", in_order);
    check_everywhere("  tables of local numbers", tables && k == space.touching_cells().size());
    check_everywhere("  only ghosts are left out", ghosts);

    fem::Vector x(space.vector_layout());
    for (const auto i : x.locally_owned_elements())
      x[i] = i;
    const auto field = fem::replicate(space, x);
    bool       whole = true;
    for (unsigned int node = 0; node < field.size(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        whole = whole && field[node][c] == 3. * numbers[node] + c;
    check_everywhere("  gathered on every rank", whole);
    if (degree == 2)
      check_linear_part(space);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  is_first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

  scene::Scene scene;
  scene.supports = {support("wall", "x < 1e-9"), support("rail", "y < 1e-9 && x > 1", "y")};
  for (const auto &n : {std::array<unsigned int, 3>{{7, 3, 3}}, {{2, 1, 1}}})
    {
      const auto body = box(Point<3>(3, 1, 1), n, 0.3, 1.5);
      select(*body, scene);
      if (is_first_rank)
        std::cout << "--- " << n[0] << " x " << n[1] << " x " << n[2] << " bricks\n";
      const auto triangulation = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
      check_triangulation(*body, *triangulation);
      check_space(triangulation, 1);
      check_space(triangulation, 2);
    }

  // More ranks than cells.
  const auto body = std::make_shared<mesh::TetMesh>();
  body->points    = {Point<3>(), Point<3>(1, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)};
  body->cells     = {{{0, 1, 2, 3}}};
  body->regions   = {0};
  mesh::finalize(*body, "one cell");
  if (is_first_rank)
    std::cout << "--- one cell\n";
  const auto triangulation = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
  check_triangulation(*body, *triangulation);
  check_space(triangulation, 1);
  check_space(triangulation, 2);
}
