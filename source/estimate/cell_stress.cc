// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/cell_stress.h"

#include "tetradapt/compare/field_evaluator.h"

#include <deal.II/lac/full_matrix.h>

#include <algorithm>

namespace tetradapt::estimate
{
  namespace
  {
    constexpr unsigned int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  }

  ElasticMatrices::ElasticMatrices(const laws::LinearLaw &law)
  {
    const auto                 C = law.tangent_at_rest();
    dealii::FullMatrix<double> inverse(6, 6);
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
        inverse(a, b) = stiffness[a][b] = C[pairs[a][0]][pairs[a][1]][pairs[b][0]][pairs[b][1]];
    inverse.gauss_jordan();
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
        {
          metric[a][b] = compliance[a][b] = inverse(a, b);
          inverse_metric[a][b]            = stiffness[a][b];
        }
    shear_modulus = (stiffness[3][3] + stiffness[4][4] + stiffness[5][5]) / 3.;
  }

  ElasticMatrices::ElasticMatrices(const laws::LinearLaw &law, const laws::PressureForm &form)
    : shear_modulus(form.shear_modulus)
  {
    const double mu   = form.shear_modulus;
    const double bulk = std::min(5. * mu, 1. / form.inverse_rest + form.kept_lambda + 2. / 3. * mu);
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
        {
          dealii::SymmetricTensor<2, 3> s, t;
          s[pairs[a][0]][pairs[a][1]] = 1.;
          t[pairs[b][0]][pairs[b][1]] = 1.;
          compliance[a][b]
            = .25 * (law.complementary_density(s + t) - law.complementary_density(s - t));
          const double mean    = a < 3 && b < 3 ? 1. / 3. : 0.;
          const double unit    = a == b ? (a < 3 ? 1. : .5) : 0.;
          stiffness[a][b]      = 2. * mu * unit + 3. * form.kept_lambda * mean;
          inverse_metric[a][b] = 2. * mu * (unit - mean) + 3. * bulk * mean;
          metric[a][b]         = (unit * (a < 3 ? 1. : 4.) - mean) / (2. * mu) + mean / (3. * bulk);
        }
  }

  CellMaterials::CellMaterials(const mechanics::MaterialMap &materials, const mesh::TetMesh &mesh)
    : index(mesh.n_cells())
  {
    std::map<int, unsigned int> of_region;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const int region = mesh.regions[cell];
        if (cell > 0 && region == mesh.regions[cell - 1])
          {
            index[cell] = index[cell - 1];
            continue;
          }
        const auto found = of_region.emplace(region, matrices.size());
        if (found.second && materials.is_mixed())
          matrices.emplace_back(materials.linear_law(region), materials.pressure_form(region));
        else if (found.second)
          matrices.emplace_back(materials.linear_law(region));
        index[cell] = found.first->second;
      }
  }

  CellStress::CellStress(const mesh::NodalField       &u_h,
                         const mechanics::MaterialMap &materials,
                         const bool                    with_thermal_strain)
    : mesh(u_h.mesh()), material_map(materials), cell_materials(materials, u_h.mesh()),
      linear(u_h.degree() == 2), thermal(with_thermal_strain && materials.has_thermal_strain())
  {
    const unsigned int n_cells = mesh.n_cells();
    values.resize(std::size_t(n_cells) * (linear ? 24 : 6));
    double strain[6];
    for (unsigned int cell = 0; cell < n_cells; ++cell)
      {
        const ElasticMatrices &matrices = cell_materials[cell];
        if (linear)
          {
            const auto gradients = compare::vertex_gradients(u_h, cell);
            for (unsigned int i = 0; i < 4; ++i)
              {
                double *const stress = &values[24 * std::size_t(cell) + 6 * i];
                engineering_strain(gradients[i], strain);
                matrices.stress(strain, stress);
                if (u_h.pressure)
                  for (unsigned int c = 0; c < 3; ++c)
                    stress[c] -= u_h.pressure->values[u_h.pressure->nodes->node(cell, i)];
              }
            continue;
          }
        const auto   g = mesh::barycentric_gradients(mesh, cell);
        Tensor<2, 3> gradient;
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int c = 0; c < 3; ++c)
            gradient[c] += u_h.values[mesh.cells[cell][i]][c] * g[i];
        engineering_strain(gradient, strain);
        matrices.stress(strain, &values[6 * std::size_t(cell)]);
      }
  }

  void
  CellStress::subtract_thermal(const unsigned int cell, const Point<3> &point, double *stress) const
  {
    double strain[6], thermal[6];
    engineering_strain(Tensor<2, 3>(material_map.thermal_strain(mesh.regions[cell], point)),
                       strain);
    cell_materials[cell].stress(strain, thermal);
    for (unsigned int a = 0; a < 6; ++a)
      stress[a] -= thermal[a];
  }
} // namespace tetradapt::estimate
