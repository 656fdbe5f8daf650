// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/pressure_mass.h"

#include "tetradapt/mechanics/volume_density.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <map>

namespace tetradapt::mechanics
{
  PressureMass::PressureMass(const PressureSpace &space, const MaterialMap &materials)
  {
    const fem::Space                           &displacements = space.displacements();
    const mesh::TetMesh                        &mesh          = displacements.tet_mesh();
    const unsigned int                          n             = space.n_owned_nodes();
    std::vector<std::map<unsigned int, double>> rows(n);
    compliance.resize(n);
    weight.resize(n);
    for (const unsigned int cell : displacements.touching_cells())
      {
        const double       volume = mesh::cell_volume(mesh, cell);
        const PressureForm law    = materials.pressure_form(mesh.regions[cell]);
        for (unsigned int i = 0; i < 4; ++i)
          {
            const unsigned int row = space.cell_node(cell, i);
            if (row >= n)
              continue;
            compliance[row] = law.inverse_rest;
            weight[row]     = 1. / (law.shear_modulus + law.kept_lambda) + law.inverse_rest;
            for (unsigned int j = 0; j < 4; ++j)
              rows[row][space.cell_node(cell, j)] += volume * (i == j ? 0.1 : 0.05);
          }
      }
    row_starts.push_back(0);
    for (unsigned int row = 0; row < n; ++row)
      {
        for (const auto &[column, value] : rows[row])
          {
            columns.push_back(column);
            values.push_back(value);
          }
        diagonal.push_back(rows[row].at(row));
        row_starts.push_back(columns.size());
      }
    for (Vector *vector : {&residual, &direction, &product})
      vector->reinit(space.vector_layout());
  }

  void
  PressureMass::vmult(Vector &q, const Vector &p) const
  {
    p.update_ghost_values();
    const double *const x = p.begin();
    for (unsigned int row = 0; row + 1 < row_starts.size(); ++row)
      {
        double sum = 0.;
        for (std::size_t k = row_starts[row]; k < row_starts[row + 1]; ++k)
          sum += values[k] * x[columns[k]];
        q.local_element(row) = sum;
      }
    p.zero_out_ghost_values();
  }

  void
  PressureMass::vmult_compliance(Vector &q, const Vector &p) const
  {
    vmult(q, p);
    for (unsigned int row = 0; row < compliance.size(); ++row)
      q.local_element(row) *= compliance[row];
  }

  void
  PressureMass::precondition(Vector &p, const Vector &q) const
  {
    constexpr unsigned int n_steps = 4;
    constexpr double       center = 1.5, radius = 1.; // of the interval of eigenvalues
    double                 factor = radius / center;
    residual                      = q;
    for (unsigned int row = 0; row < diagonal.size(); ++row)
      direction.local_element(row) = q.local_element(row) / (center * diagonal[row]);
    p = direction;
    for (unsigned int step = 1; step < n_steps; ++step)
      {
        vmult(product, direction);
        residual -= product;
        const double next = 1. / (2. * center / radius - factor);
        for (unsigned int row = 0; row < diagonal.size(); ++row)
          direction.local_element(row)
            = next * factor * direction.local_element(row)
              + 2. * next / radius * residual.local_element(row) / diagonal[row];
        factor = next;
        p += direction;
      }
    for (unsigned int row = 0; row < weight.size(); ++row)
      p.local_element(row) /= weight[row];
  }

  Vector
  thermal_volume_load(const PressureSpace &space, const MaterialMap &materials)
  {
    Vector load(space.vector_layout());
    if (!materials.has_thermal_strain())
      return load;
    const fem::Space      &displacements = space.displacements();
    const mesh::TetMesh   &mesh          = displacements.tet_mesh();
    VolumeDensity::Samples samples;
    for (const unsigned int cell : displacements.touching_cells())
      {
        if (!materials.thermal_density().acts_in(mesh.regions[cell]))
          continue;
        const double volume = mesh::cell_volume(mesh, cell);
        materials.thermal_density().sample_compactly(mesh, cell, samples);
        for (const auto &point : samples)
          for (unsigned int i = 0; i < 4; ++i)
            if (space.cell_node(cell, i) < space.n_owned_nodes())
              load.local_element(space.cell_node(cell, i))
                -= point.weight * volume * point.b[i] * 3. * point.value[0];
      }
    return load;
  }
} // namespace tetradapt::mechanics
