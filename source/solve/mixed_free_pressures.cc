// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/exceptions.h"
#include "tetradapt/solve/mixed_solver.h"

#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

namespace tetradapt::solve
{
  namespace
  {
    using dealii::numbers::invalid_unsigned_int;

    /** For every vertex, a number of the connected incompressible part that it belongs to;
     * invalid for the others. */
    std::vector<unsigned int>
    incompressible_parts(const mesh::TetMesh &mesh, const mechanics::MaterialMap &materials)
    {
      std::map<int, bool> incompressible;
      for (const int region : mesh.regions)
        if (incompressible.count(region) == 0)
          incompressible[region] = materials.pressure_form(region).inverse_rest == 0.;
      std::vector<unsigned int> parent(mesh.n_points(), invalid_unsigned_int);
      const auto                root = [&](unsigned int v) {
        while (parent[v] != v)
          v = parent[v] = parent[parent[v]];
        return v;
      };
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        if (incompressible[mesh.regions[cell]])
          for (const unsigned int v : mesh.cells[cell])
            {
              if (parent[v] == invalid_unsigned_int)
                parent[v] = v;
              parent[root(v)] = root(mesh.cells[cell][0]);
            }
      for (unsigned int v = 0; v < parent.size(); ++v)
        if (parent[v] != invalid_unsigned_int)
          parent[v] = root(v);
      return parent;
    }
  } // namespace

  void
  MixedSolver::find_free_pressures()
  {
    const mesh::TetMesh       &mesh  = model.space->tet_mesh();
    const auto                 parts = incompressible_parts(mesh, model.materials);
    const mesh::PressureNodes &nodes = *pressures->nodes();
    std::vector<char>          of_incompressible(nodes.size(), 0);
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      if (model.materials.pressure_form(mesh.regions[cell]).inverse_rest == 0.)
        for (unsigned int i = 0; i < 4; ++i)
          of_incompressible[nodes.node(cell, i)] = 1;

    std::map<unsigned int, unsigned int> number;
    for (unsigned int v = 0; v < parts.size(); ++v)
      if (parts[v] == v)
        number.emplace(v, number.size());
    for (const auto &part : number)
      {
        Vector constant(pressures->vector_layout());
        for (unsigned int node = 0; node < pressures->n_owned_nodes(); ++node)
          {
            const unsigned int field_node = pressures->field_node(node);
            if (of_incompressible[field_node] != 0 && parts[nodes.vertex(field_node)] == part.first)
              constant.local_element(node) = 1.;
          }
        if (divergence.relative_force(constant) > 1e-9)
          continue;
        check_volume(constant);
        free_pressures.push_back(std::move(constant));
      }
  }

  void
  MixedSolver::check_volume(const Vector &free_pressure)
  {
    Vector u(model.space->vector_layout()), flow(pressures->vector_layout());
    model.fixed.distribute(u);
    divergence.vmult(flow, u);
    // How much the equations want the volume to change, apart from what flows in or out.
    const double change = volume_load * free_pressure - flow * free_pressure;
    double       scale  = std::abs(volume_load * free_pressure);
    for (const auto &face : model.space->tet_mesh().faces)
      {
        dealii::Tensor<1, 3> mean;
        for (const unsigned int v : face.vertices)
          mean += model.prescribed.values[v] / 3.;
        scale += std::abs(mean * mesh::face_area_vector(model.space->tet_mesh(), face));
      }
    if (std::abs(change) <= 1e-10 * scale)
      return;
    std::ostringstream share;
    share.precision(3);
    share << 100. * std::abs(change) / scale << " % of what they move in and out";
    // Supports that keep the volume do so up to their interpolation on the mesh.
    if (std::abs(change) > 0.03 * scale)
      throw core::InputError(
        "Supports: they hold all of the boundary of an incompressible part of the body, and with "
        "the thermal strain they change its volume by "
        + share.str()
        + ". Leave a part of the boundary free, prescribe displacements that keep the volume, or "
          "use a Poisson ratio below 0.5.");
    log.warning("Supports: interpolated on the mesh, they change the volume of an incompressible "
                "part of the body whose whole boundary they hold by "
                + share.str() + "; the solution distributes this change evenly.");
    Vector weights(free_pressure);
    mass.vmult(weights, free_pressure);
    volume_load.add(-change / (weights * free_pressure), weights);
  }
} // namespace tetradapt::solve
