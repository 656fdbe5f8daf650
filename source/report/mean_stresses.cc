// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/mean_stresses.h"

#include "tetradapt/mechanics/cauchy_stress.h"

#include <cmath>

namespace tetradapt::report
{
  using dealii::Point;
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  const std::array<const char *, 6> stress_component_names{{"xx", "yy", "zz", "xy", "yz", "xz"}};

  namespace
  {
    constexpr mesh::Barycentric centroid{{.25, .25, .25, .25}};

    /** The four-point rule of degree 2: barycentric coordinates
     * (5+3 sqrt 5)/20 and three times (5-sqrt 5)/20, equal weights. */
    mesh::Barycentric
    gauss_point(const unsigned int q)
    {
      const double      root = std::sqrt(5.);
      mesh::Barycentric b;
      b.fill((5. - root) / 20.);
      b[q] = (5. + 3. * root) / 20.;
      return b;
    }

    Point<3>
    position(const mesh::TetMesh &mesh, const unsigned int cell, const mesh::Barycentric &b)
    {
      Point<3> p;
      for (unsigned int i = 0; i < 4; ++i)
        p += b[i] * mesh.points[mesh.cells[cell][i]];
      return p;
    }

    /** Cauchy's stress in the mean of the quadrature points of the stiffness. */
    SymmetricTensor<2, 3>
    mean_cauchy_stress(const mesh::NodalField      &u,
                       const unsigned int           cell,
                       const laws::ConstitutiveLaw &law)
    {
      if (u.degree() == 1)
        return mechanics::cauchy_stress(law, u.gradient(cell, centroid));
      SymmetricTensor<2, 3> stress;
      for (unsigned int q = 0; q < 4; ++q)
        stress += 0.25 * mechanics::cauchy_stress(law, u.gradient(cell, gauss_point(q)));
      return stress;
    }

    SymmetricTensor<2, 3>
    mean_stress(const mesh::NodalField       &u,
                const unsigned int            cell,
                const mechanics::MaterialMap &materials,
                const laws::LinearLaw        &law)
    {
      const bool thermal = materials.has_thermal_strain();
      if (u.pressure)
        {
          const auto   form = materials.pressure_form(u.mesh().regions[cell]);
          Tensor<2, 3> strain(u.gradient(cell, centroid));
          for (unsigned int q = 0; thermal && q < 4; ++q)
            strain
              -= 0.25
                 * Tensor<2, 3>(materials.thermal_strain(u.mesh().regions[cell],
                                                         position(u.mesh(), cell, gauss_point(q))));
          return form.stress(strain, u.pressure->value(cell, centroid));
        }
      const SymmetricTensor<2, 3> stress = law.stress(u.gradient(cell, centroid));
      if (!thermal)
        return stress;

      SymmetricTensor<2, 3> thermal_strain;
      for (unsigned int q = 0; q < 4; ++q)
        thermal_strain += 0.25
                          * materials.thermal_strain(u.mesh().regions[cell],
                                                     position(u.mesh(), cell, gauss_point(q)));
      return stress - law.tangent_at_rest() * thermal_strain;
    }
  } // namespace

  MeanStresses
  mean_stresses(const mesh::NodalField &u, const mechanics::MaterialMap &materials)
  {
    const mesh::TetMesh &mesh = u.mesh();

    MeanStresses result;
    result.stress.resize(6 * std::size_t(mesh.n_cells()));
    result.von_mises.resize(mesh.n_cells());
    result.pressure.resize(mesh.n_cells());
    const bool                   is_linear = materials.is_linear();
    const laws::ConstitutiveLaw *law       = nullptr;
    int                          region    = 0;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        if (law == nullptr || mesh.regions[cell] != region)
          {
            region = mesh.regions[cell];
            law    = &materials.law(region);
          }
        const SymmetricTensor<2, 3> s
          = is_linear ? mean_stress(u, cell, materials, materials.linear_law(region))
                      : mean_cauchy_stress(u, cell, *law);

        double *const out = &result.stress[6 * std::size_t(cell)];
        out[0]            = s[0][0];
        out[1]            = s[1][1];
        out[2]            = s[2][2];
        out[3]            = s[0][1];
        out[4]            = s[1][2];
        out[5]            = s[0][2];

        result.pressure[cell] = -trace(s) / 3.;

        const double xy = s[0][0] - s[1][1], yz = s[1][1] - s[2][2], zx = s[2][2] - s[0][0];
        const double shear     = s[0][1] * s[0][1] + s[1][2] * s[1][2] + s[0][2] * s[0][2];
        result.von_mises[cell] = std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3. * shear);
      }
    return result;
  }
} // namespace tetradapt::report
