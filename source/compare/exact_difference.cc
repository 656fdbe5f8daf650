// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/difference.h"
#include "tetradapt/compare/exact_solution.h"
#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/compare/parallel.h"
#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/mechanics/energy_density.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::compare
{
  namespace
  {
    /** Heights of a cell over its four faces. */
    std::array<double, 4>
    heights(const mesh::TetMesh &mesh, const unsigned int cell)
    {
      const auto            g = mesh::barycentric_gradients(mesh, cell);
      std::array<double, 4> h;
      for (unsigned int i = 0; i < 4; ++i)
        h[i] = 1. / g[i].norm();
      return h;
    }

    /**
     * Step of the differences at @p b: three steps stay inside the cell, where
     * the solution is defined and, if the mesh is made for it, smooth; and at most
     * a thousandth of the body, where rounding (1e-16/1e-3) and the neglected
     * terms (for a wave of a tenth of the body, (0.06)^6/140) are both small.
     */
    double
    step(const std::array<double, 4> &h, const mesh::Barycentric &b, const double body)
    {
      double distance = b[0] * h[0];
      for (unsigned int i = 1; i < 4; ++i)
        distance = std::min(distance, b[i] * h[i]);
      return std::min(1e-3 * body, distance / 3.01);
    }
  } // namespace

  Difference
  difference_to_exact(const mesh::NodalField               &u_h,
                      const scene::ExactSolutionParameters &exact_solution,
                      const mechanics::MaterialMap         &materials,
                      MPI_Comm                              communicator,
                      const ExcludedRegion                 &excluded)
  {
    const mesh::TetMesh &mesh    = u_h.mesh();
    const unsigned int   n_cells = mesh.n_cells();
    const Slice          slice   = own_slice(n_cells, communicator);
    const TetQuadrature &rule    = tet_quadrature(u_h.degree() == 1 ? 5 : 6);
    const auto           box     = mesh::bounding_box(mesh);
    const double         body    = (box.second - box.first).norm();
    Difference           result;
    result.cell_energy.assign(n_cells, 0.);
    std::vector<double> sums(7, 0.);

    core::together(communicator, [&] {
      const std::vector<bool> left_out = excluded.cells(mesh);
      const ExactSolution     exact(exact_solution);
      const FieldEvaluator    evaluator(u_h);
      const bool              thermal = materials.has_thermal_strain();
      for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
        {
          if (left_out[cell])
            continue;
          const mechanics::EnergyDensity density(materials, mesh.regions[cell]);
          const double                   volume = mesh::cell_volume(mesh, cell);
          const auto                     h      = heights(mesh, cell);
          const double mu     = laws::shear_modulus(materials.linear_law(mesh.regions[cell]));
          double       energy = 0.;
          for (unsigned int q = 0; q < rule.points.size(); ++q)
            {
              const mesh::Barycentric &b      = rule.points[q];
              const Point<3>           p      = position(mesh, cell, b);
              const double             weight = volume * rule.weights[q];
              const Tensor<1, 3>       u      = exact.value(p);
              const Tensor<2, 3>       G      = exact.gradient(p, step(h, b, body));
              const Tensor<2, 3>       G_h    = evaluator.gradient(cell, b);
              const Tensor<2, 3>       dG     = G - G_h;
              sums[0] += weight * (u - evaluator.value(cell, b)).norm_square();
              sums[1] += weight * dG.norm_square();
              Tensor<2, 3> free; // strain without stress
              if (thermal)
                free = materials.thermal_strain(mesh.regions[cell], p);
              energy
                += weight * density.of_error(G - free, G_h - free, evaluator.pressure(cell, b));
              sums[3] += weight * u.norm_square();
              sums[4] += weight * G.norm_square();
              sums[6] += 2. * mu * weight * G.norm_square();
              sums[5]
                += weight
                   * materials.linear_law(mesh.regions[cell]).energy_density(symmetrize(G - free));
            }
          result.cell_energy[cell] = std::sqrt(std::max(energy, 0.));
          sums[2] += energy;
        }
    });
    sum_over_ranks(sums, communicator);
    gather_slices(result.cell_energy, n_cells, 1, communicator);
    double *const norms[6] = {&result.l2,
                              &result.h1,
                              &result.energy,
                              &result.l2_norm,
                              &result.h1_norm,
                              &result.energy_norm};
    for (unsigned int i = 0; i < 6; ++i)
      *norms[i] = std::sqrt(std::max(sums[i], 0.));
    result.energy_noise = mechanics::EnergyNorm::rounding * std::sqrt(sums[6]);
    return result;
  }
} // namespace tetradapt::compare
