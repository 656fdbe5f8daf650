// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/recovery.h"

#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/compare/parallel.h"
#include "tetradapt/compare/polynomial_fit.h"
#include "tetradapt/compare/recovery_patches.h"
#include "tetradapt/compare/tet_quadrature.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::compare
{
  using dealii::SymmetricTensor;

  namespace
  {
    /** Stress of u_h at a point, without what thermal strain would cause freely. */
    class StressEvaluator
    {
    public:
      StressEvaluator(const mesh::NodalField &u_h, const mechanics::MaterialMap &materials)
        : gradients(u_h), mesh(u_h.mesh()), materials(materials),
          thermal(materials.has_thermal_strain())
      {
      }

      SymmetricTensor<2, 3>
      operator()(const mechanics::ConstitutiveLaw &law,
                 const unsigned int                cell,
                 const mesh::Barycentric          &b,
                 const Point<3>                   &p) const
      {
        Tensor<2, 3> G = gradients.gradient(cell, b);
        if (thermal)
          G -= Tensor<2, 3>(materials.thermal_strain(mesh.regions[cell], p));
        return law.stress(G);
      }

    private:
      FieldEvaluator                gradients;
      const mesh::TetMesh          &mesh;
      const mechanics::MaterialMap &materials;
      bool                          thermal;
    };

    /** A point with the stress there. */
    struct Sample
    {
      Point<3> point;
      double   stress[6];
    };

    /** A polynomial around a patch's vertex, in coordinates divided by length. */
    struct PatchPolynomial
    {
      double length;
      double coefficients[60]; ///< as PolynomialFit gives them
    };
    constexpr unsigned int n_patch_numbers = sizeof(PatchPolynomial) / sizeof(double);

    std::vector<Sample>
    sample_stresses(const mesh::NodalField       &u_h,
                    const StressEvaluator        &stress,
                    const mechanics::MaterialMap &materials,
                    const TetQuadrature          &rule)
    {
      const mesh::TetMesh &mesh = u_h.mesh();
      std::vector<Sample>  samples;
      samples.reserve(std::size_t(mesh.n_cells()) * rule.points.size());
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        {
          const auto &law = materials.law(mesh.regions[cell]);
          for (const auto &b : rule.points)
            {
              Sample sample;
              sample.point = position(mesh, cell, b);
              const auto s = stress(law, cell, b, sample.point);
              for (unsigned int c = 0; c < 6; ++c)
                sample.stress[c] = s.access_raw_entry(c);
              samples.push_back(sample);
            }
        }
      return samples;
    }

    /** Fits a polynomial of @p degree to the samples of @p cells; false if they do
     * not determine it well. */
    bool
    fit(const Point<3>                  &center,
        const std::vector<unsigned int> &cells,
        const std::vector<Sample>       &samples,
        const unsigned int               n_a_cell,
        const unsigned int               degree,
        PatchPolynomial                 &result)
    {
      if (degree > 0 && cells.size() * n_a_cell < 2 * n_monomials[degree])
        return false;
      double square = 0.;
      for (const unsigned int cell : cells)
        for (unsigned int q = 0; q < n_a_cell; ++q)
          square
            = std::max(square,
                       (samples[std::size_t(cell) * n_a_cell + q].point - center).norm_square());
      result.length        = std::sqrt(square);
      const double  factor = 1. / result.length;
      PolynomialFit polynomial(degree);
      for (const unsigned int cell : cells)
        for (unsigned int q = 0; q < n_a_cell; ++q)
          {
            const Sample &s = samples[std::size_t(cell) * n_a_cell + q];
            polynomial.add(factor * (s.point[0] - center[0]),
                           factor * (s.point[1] - center[1]),
                           factor * (s.point[2] - center[2]),
                           s.stress);
          }
      std::fill(result.coefficients, result.coefficients + 60, 0.);
      return polynomial.solve(result.coefficients);
    }

    std::vector<double>
    fit_patches(const mesh::NodalField    &u_h,
                const RecoveryPatches     &patches,
                const std::vector<Sample> &samples,
                MPI_Comm                   communicator)
    {
      const unsigned int        n_a_cell = u_h.degree() == 1 ? 1 : 4;
      const Slice               slice    = own_slice(patches.size(), communicator);
      std::vector<double>       result(std::size_t(patches.size()) * n_patch_numbers);
      std::vector<unsigned int> cells;
      for (unsigned int patch = slice.begin; patch < slice.end; ++patch)
        {
          const Point<3> &center = u_h.mesh().points[patches.vertex[patch]];
          PatchPolynomial polynomial;
          bool            done = false;
          // A constant is always determined: the loops end.
          for (unsigned int degree = u_h.degree() + 1; !done && degree-- > 0;)
            for (unsigned int layers = 0; !done && layers < (degree > 0 ? 3 : 1); ++layers)
              {
                patches.cells_of(patch, layers, cells);
                done = fit(center, cells, samples, n_a_cell, degree, polynomial);
              }
          double *out = &result[std::size_t(patch) * n_patch_numbers];
          out[0]      = polynomial.length;
          std::copy(polynomial.coefficients, polynomial.coefficients + 60, out + 1);
        }
      gather_slices(result, patches.size(), n_patch_numbers, communicator);
      return result;
    }

    /** The recovered stress at @p p of a cell with barycentric coordinates @p b. */
    SymmetricTensor<2, 3>
    recovered_stress(const unsigned int                 degree,
                     const mesh::TetMesh               &mesh,
                     const std::array<unsigned int, 4> &vertices,
                     const std::array<unsigned int, 4> &patches,
                     const std::vector<double>         &polynomials,
                     const mesh::Barycentric           &b,
                     const Point<3>                    &p)
    {
      double             sum[6] = {0., 0., 0., 0., 0., 0.};
      const unsigned int n      = n_monomials[degree];
      for (unsigned int i = 0; i < 4; ++i)
        {
          const double *polynomial = &polynomials[std::size_t(patches[i]) * n_patch_numbers];
          const double  factor     = 1. / polynomial[0];
          const auto   &center     = mesh.points[vertices[i]];
          double        m[10];
          monomials(degree,
                    factor * (p[0] - center[0]),
                    factor * (p[1] - center[1]),
                    factor * (p[2] - center[2]),
                    m);
          for (unsigned int k = 0; k < n; ++k)
            for (unsigned int c = 0; c < 6; ++c)
              sum[c] += b[i] * m[k] * polynomial[1 + 6 * k + c];
        }
      SymmetricTensor<2, 3> stress;
      for (unsigned int c = 0; c < 6; ++c)
        stress.access_raw_entry(c) = sum[c];
      return stress;
    }
  } // namespace

  RecoveryEstimate
  recovery_estimate(const mesh::NodalField       &u_h,
                    const mechanics::MaterialMap &materials,
                    MPI_Comm                      communicator)
  {
    const mesh::TetMesh  &mesh    = u_h.mesh();
    const unsigned int    n_cells = mesh.n_cells(), degree = u_h.degree();
    const StressEvaluator stress(u_h, materials);
    RecoveryEstimate      result;
    result.cell_energy.assign(n_cells, 0.);

    together(communicator, [&] {
      const RecoveryPatches patches(mesh);
      const auto            samples
        = sample_stresses(u_h, stress, materials, tet_quadrature(degree == 1 ? 1 : 2));
      const auto           polynomials = fit_patches(u_h, patches, samples, communicator);
      const TetQuadrature &rule        = tet_quadrature(degree == 1 ? 2 : 5);
      const Slice          slice       = own_slice(n_cells, communicator);
      for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
        {
          const auto &law = materials.law(mesh.regions[cell]);
          double      sum = 0.;
          for (unsigned int q = 0; q < rule.points.size(); ++q)
            {
              const Point<3> p          = position(mesh, cell, rule.points[q]);
              const auto     difference = recovered_stress(degree,
                                                       mesh,
                                                       mesh.cells[cell],
                                                       patches.of_cell[cell],
                                                       polynomials,
                                                       rule.points[q],
                                                       p)
                                      - stress(law, cell, rule.points[q], p);
              sum += rule.weights[q] * law.complementary_density(difference);
            }
          result.cell_energy[cell] = std::sqrt(std::max(sum, 0.) * mesh::cell_volume(mesh, cell));
        }
    });
    gather_slices(result.cell_energy, n_cells, 1, communicator);
    double sum = 0.;
    for (const double e : result.cell_energy)
      sum += e * e;
    result.global = std::sqrt(sum);
    return result;
  }
} // namespace tetradapt::compare
