// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_cell_stress_h
#define tetradapt_estimate_cell_stress_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/nodal_field.h"

namespace tetradapt::estimate
{
  using dealii::Point;
  using dealii::Tensor;

  /** Number of a stress component in the order xx, yy, zz, xy, xz, yz, in which
   * stresses are plain arrays here. */
  constexpr std::array<std::array<unsigned int, 3>, 3> stress_index{
    {{{0, 3, 4}}, {{3, 1, 5}}, {{4, 5, 2}}}};

  /**
   * A law's tangent at rest and its inverse, as matrices between stresses and
   * strains whose shears are the engineering ones (2 eps_xy).
   *
   * In mixed form the stiffness is that at a given pressure, of 2 mu and gamma
   * (laws::PressureForm), and the compliance that of
   * the law (zero for a pressure that changes no volume).
   */
  struct ElasticMatrices
  {
    explicit ElasticMatrices(const laws::LinearLaw &law);
    /** Of the mixed form. */
    ElasticMatrices(const laws::LinearLaw &law, const laws::PressureForm &form);

    /** stress = C strain */
    void
    stress(const double *strain, double *result) const
    {
      for (unsigned int a = 0; a < 6; ++a)
        {
          result[a] = 0.;
          for (unsigned int b = 0; b < 6; ++b)
            result[a] += stiffness[a][b] * strain[b];
        }
    }

    /** stress : C^-1 : stress */
    double
    complementary_density(const double *stress) const
    {
      double sum = 0.;
      for (unsigned int a = 0; a < 6; ++a)
        {
          double strain = 0.;
          for (unsigned int b = 0; b < 6; ++b)
            strain += compliance[a][b] * stress[b];
          sum += strain * stress[a];
        }
      return sum;
    }

    double stiffness[6][6], compliance[6][6];
    /** A positive metric of stresses and its inverse, for fits: compliance and stiffness, but
     * in mixed form with a bulk modulus of at most 5 mu, so that pressures are fitted also. */
    double metric[6][6], inverse_metric[6][6];
    double shear_modulus; ///< mean of the three on the diagonal
  };

  /** Engineering strain of a displacement gradient du_i/dx_j. */
  inline void
  engineering_strain(const Tensor<2, 3> &gradient, double *strain)
  {
    for (unsigned int i = 0; i < 3; ++i)
      strain[i] = gradient[i][i];
    strain[3] = gradient[0][1] + gradient[1][0];
    strain[4] = gradient[0][2] + gradient[2][0];
    strain[5] = gradient[1][2] + gradient[2][1];
  }

  /** The elastic matrices of every cell of a mesh. */
  class CellMaterials
  {
  public:
    CellMaterials(const mechanics::MaterialMap &materials, const mesh::TetMesh &mesh);

    const ElasticMatrices &
    operator[](const unsigned int cell) const
    {
      return matrices[index[cell]];
    }

  private:
    std::vector<ElasticMatrices> matrices; ///< one a region
    std::vector<unsigned int>    index;    ///< one a cell
  };

  /**
   * The stress C : (eps(u_h) - eps_thermal) of a displacement, C the law's tangent at
   * rest. Without thermal strain it is constant in a cell for degree 1 and linear for
   * degree 2: it is computed once, at no or at four vertices of each cell.
   *
   * Of a solution in mixed form p_h I is subtracted from it, and C is that at a given pressure.
   */
  class CellStress
  {
  public:
    /** Keeps references. @param with_thermal_strain false: C : eps(u_h) alone. */
    CellStress(const mesh::NodalField       &u_h,
               const mechanics::MaterialMap &materials,
               bool                          with_thermal_strain = true);

    const CellMaterials &
    materials() const
    {
      return cell_materials;
    }

    bool
    has_thermal_strain() const
    {
      return thermal;
    }

    /** C : eps(u_h) in @p cell: one stress (degree 1) or four, at its vertices. */
    const double *
    elastic(const unsigned int cell) const
    {
      return &values[std::size_t(cell) * (linear ? 24 : 6)];
    }

    /** The stress at a point of @p cell, which is given in both kinds of coordinates. */
    void
    at(const unsigned int       cell,
       const mesh::Barycentric &b,
       const Point<3>          &point,
       double                  *stress) const
    {
      const double *s = elastic(cell);
      for (unsigned int a = 0; a < 6; ++a)
        stress[a]
          = linear ? b[0] * s[a] + b[1] * s[6 + a] + b[2] * s[12 + a] + b[3] * s[18 + a] : s[a];
      if (thermal)
        subtract_thermal(cell, point, stress);
    }

    /** Subtracts C : eps_thermal at a point of @p cell from @p stress. */
    void
    subtract_thermal(unsigned int cell, const Point<3> &point, double *stress) const;

  private:
    const mesh::TetMesh          &mesh;
    const mechanics::MaterialMap &material_map;
    CellMaterials                 cell_materials;
    bool                          linear; ///< in a cell; else constant
    bool                          thermal;
    std::vector<double>           values;
  };
} // namespace tetradapt::estimate

#endif
