// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/root_of_squares.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/estimate/cell_stress.h"
#include "tetradapt/estimate/enriched/enriched_problem.h"
#include "tetradapt/estimate/extrapolation.h"
#include "tetradapt/estimate/stress_difference.h"
#include "tetradapt/mesh/face_table.h"
#include "tetradapt/solve/conjugate_gradients.h"

namespace tetradapt::estimate
{
  namespace
  {
    using Values = EnrichedSpace::Values;

    /**
     * Blocks a(phi_i, phi_i) of components of all functions, six numbers each (xx, yy, zz, xy,
     * xz, yz), for they are symmetric. As a preconditioner
     * needs no more, every law is taken for an isotropic one: then the block of a
     * function whose gradient is sum_k w_k g_k, with g_k those of the barycentric
     * coordinates, is sum_kl (int w_k w_l) B(g_k, g_l) with
     * B(a,b) = lambda a b^T + mu b a^T + mu a.b I.
     */
    class DiagonalBlocks
    {
    public:
      DiagonalBlocks(const EnrichedSpace    &space,
                     const mesh::NodalField &u_h,
                     const CellMaterials    &materials)
        : values(2 * space.size(), 0.)
      {
        const mesh::TetMesh &mesh = u_h.mesh();
        for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
          {
            const auto   g  = mesh::barycentric_gradients(mesh, cell);
            const double mu = materials[cell].shear_modulus;
            set_products(g, materials[cell].stiffness[0][1], mu, mesh::cell_volume(mesh, cell));
            for (unsigned int i = 0; i < u_h.n_nodes_per_cell(); ++i)
              add_node(u_h.degree(), i, u_h.node(cell, i));
            for (unsigned int i = 0; i < space.surplus().n_per_cell(); ++i)
              add_surplus(u_h.degree(), i, space.n_nodes() + space.surplus().function(cell, i));
          }
        if (const auto *springs = space.spring_matrix())
          for (std::size_t k = 0; k < springs->rows().size(); ++k)
            {
              constexpr std::array<unsigned int, 6> entries{{0, 4, 8, 1, 2, 5}};
              for (unsigned int i = 0; i < 6; ++i)
                values[6 * std::size_t(springs->rows()[k]) + i] += springs->diagonal(k)[entries[i]];
            }
      }

      /** Inverts the blocks in place. A function without any cell has none: zero. */
      void
      invert()
      {
        for (double *b = values.data(), *end = b + values.size(); b != end; b += 6)
          {
            const double xx = b[1] * b[2] - b[5] * b[5], xy = b[4] * b[5] - b[3] * b[2],
                         xz         = b[3] * b[5] - b[4] * b[1];
            const double det        = b[0] * xx + b[3] * xy + b[4] * xz;
            const double f          = det > 0. ? 1. / det : 0.;
            const double inverse[6] = {xx,
                                       b[0] * b[2] - b[4] * b[4],
                                       b[0] * b[1] - b[3] * b[3],
                                       xy,
                                       xz,
                                       b[3] * b[4] - b[0] * b[5]};
            for (unsigned int i = 0; i < 6; ++i)
              b[i] = f * inverse[i];
          }
      }

      /** result = blocks times x. */
      void
      multiply(const Values &x, Values &result) const
      {
        const double *b = values.data(), *v = x.data();
        double       *r = result.data();
        for (const double *end = v + x.size(); v != end; v += 3, r += 3, b += 6)
          {
            r[0] = b[0] * v[0] + b[3] * v[1] + b[4] * v[2];
            r[1] = b[3] * v[0] + b[1] * v[1] + b[5] * v[2];
            r[2] = b[4] * v[0] + b[5] * v[1] + b[2] * v[2];
          }
      }

    private:
      /** products[k][l] = volume (B(g_k, g_l) + B(g_l, g_k)) / 2 */
      void
      set_products(const std::array<Tensor<1, 3>, 4> &g,
                   const double                       lambda,
                   const double                       mu,
                   const double                       volume)
      {
        for (unsigned int k = 0; k < 4; ++k)
          for (unsigned int l = 0; l <= k; ++l)
            {
              double      *p      = products[k][l];
              const double factor = volume * (lambda + mu), dot = volume * mu * (g[k] * g[l]);
              for (unsigned int i = 0; i < 3; ++i)
                p[i] = factor * g[k][i] * g[l][i] + dot;
              p[3] = 0.5 * factor * (g[k][0] * g[l][1] + g[k][1] * g[l][0]);
              p[4] = 0.5 * factor * (g[k][0] * g[l][2] + g[k][2] * g[l][0]);
              p[5] = 0.5 * factor * (g[k][1] * g[l][2] + g[k][2] * g[l][1]);
            }
      }

      void
      add(const std::size_t  function,
          const double       factor,
          const unsigned int k,
          const unsigned int l)
      {
        const double *p = k > l ? products[k][l] : products[l][k];
        for (unsigned int i = 0; i < 6; ++i)
          values[6 * function + i] += factor * p[i];
      }

      /** An edge's function 4 b_i b_j: gradient 4 (b_j g_i + b_i g_j). */
      void
      add_bubble(const unsigned int edge, const std::size_t function)
      {
        const auto &[i, j] = mesh::edge_vertices[edge];
        add(function, 1.6, i, i);
        add(function, 1.6, j, j);
        add(function, 1.6, i, j);
      }

      void
      add_node(const unsigned int degree, const unsigned int i, const std::size_t function)
      {
        if (i < 4) // b_i, or b_i (2 b_i - 1) with the gradient (4 b_i - 1) g_i
          add(function, degree == 1 ? 1. : 0.6, i, i);
        else
          add_bubble(i - 4, function);
      }

      /** With int b^alpha = 6 V alpha! / (|alpha| + 3)!. */
      void
      add_surplus(const unsigned int degree, const unsigned int i, const std::size_t function)
      {
        if (degree == 1)
          add_bubble(i, function);
        else if (i < 6) // gradient b_j (2 b_i - b_j) g_i + b_i (b_i - 2 b_j) g_j
          {
            constexpr double square
              = HierarchicalSurplus::odd_scale * HierarchicalSurplus::odd_scale;
            const auto &[a, b] = mesh::edge_vertices[i];
            add(function, 2. / 105. * square, a, a);
            add(function, 2. / 105. * square, b, b);
            add(function, 1. / 105. * square, a, b);
          }
        else // gradient b_j b_k g_i + ...
          {
            constexpr double square
              = HierarchicalSurplus::face_scale * HierarchicalSurplus::face_scale;
            const auto &v = mesh::face_vertices[i - 6];
            for (unsigned int k = 0; k < 3; ++k)
              {
                add(function, 1. / 210. * square, v[k], v[k]);
                add(function, 1. / 210. * square, v[k], v[(k + 1) % 3]);
              }
          }
      }

      std::vector<double> values;
      double              products[4][4][6]; ///< for k >= l
    };

    /** What some steps of conjugate gradients found, and the square of the energy norm
     * that they are estimated to have left over. */
    struct RoughCorrection
    {
      Values values;
      double missing = 0.;
    };

    /**
     * What conjugate gradients have still to find, from what their steps gained: a geometric
     * series with the rate of the last gains. The first one, by far the largest, says nothing
     * of those to come. Needs four.
     */
    double
    missing_energy(const std::vector<double> &gains)
    {
      const double *last = &gains.back();
      const double  change
        = gains.size() == 4 ? last[0] / last[-2] : (last[0] + last[-1]) / (last[-2] + last[-3]);
      const double rate = std::min(std::sqrt(change), 0.95);
      return last[0] * rate / (1. - rate);
    }

    /** Four or five steps for moderate Poisson ratios, up to all of them near 0.5. */
    class RoughControl : public solve::GainControl
    {
    public:
      std::vector<double> gains;

    protected:
      State
      decide(const unsigned int step, const double residual, const double gain) override
      {
        if (step > 0)
          gains.push_back(gain);
        found += gain;
        const bool is_enough = step >= fewest_steps && gain <= small_gain * found;
        return residual == 0. || is_enough || step == most_steps ? State::success : State::iterate;
      }

    private:
      static constexpr unsigned int fewest_steps = 4, most_steps = 16;
      static constexpr double       small_gain = 0.03; // of what has been found
      double                        found      = 0.;
    };

    /** Of the free functions: the stiffness, and the inverses of its diagonal's blocks. */
    struct FreeStiffness
    {
      const EnrichedProblem &problem;

      void
      vmult(Values &forces, const Values &x) const
      {
        problem.space().multiply(x, forces);
        problem.clear_supported(forces);
      }
    };
    struct FreeInverses
    {
      const EnrichedProblem &problem;
      const DiagonalBlocks  &inverses;

      void
      vmult(Values &x, const Values &forces) const
      {
        inverses.multiply(forces, x);
        problem.clear_supported(x);
      }
    };

    RoughCorrection
    correct(const EnrichedProblem &problem, const Values &residual, const DiagonalBlocks &inverses)
    {
      RoughCorrection result;
      RoughControl    control;
      result.values.reinit(residual);
      const solve::Ending ending = solve::conjugate_gradients(
        FreeStiffness{problem}, FreeInverses{problem, inverses}, residual, control, result.values);
      if (ending == solve::Ending::not_finite)
        throw core::NumericalError("Estimator local degree extrapolation: the solution, or a load "
                                   "on it, is not finite.");
      // The matrix looks singular to rounding where nothing is left: then nothing is missing.
      if (ending == solve::Ending::converged && control.gains.size() >= 4)
        result.missing = missing_energy(control.gains);
      return result;
    }
  } // namespace

  EstimatorTraits
  LocalDegreeExtrapolation::traits() const
  {
    EstimatorTraits traits;
    traits.name = "local degree extrapolation";
    traits.documentation
      = "Energy norm of the difference to the solution of the next degree on the "
        "same mesh, which a few steps of conjugate gradients without multigrid "
        "find roughly; what they leave is estimated and added.";
    traits.needs_system = true; // for its loads
    return traits;
  }

  Estimate
  LocalDegreeExtrapolation::estimate(const EstimateInput &input) const
  {
    const mesh::NodalField       &u_h       = input.comparison.displacement();
    const mechanics::MaterialMap &materials = input.comparison.material_map();
    const EnrichedProblem         problem(input);
    const EnrichedSpace          &space = problem.space();

    DiagonalBlocks blocks(space, u_h, CellMaterials(materials, u_h.mesh()));
    blocks.invert();

    const Values supported  = problem.supported_solution();
    auto         correction = correct(problem, problem.residual(supported), blocks);
    // The difference to the solution: with what the supports prescribe beyond degree p.
    Values &difference = correction.values;
    for (std::size_t k = 3 * std::size_t(space.n_nodes()); k < difference.size(); ++k)
      difference[k] += supported[k];

    Estimate result;
    result.indicators = space.cell_products(difference, difference);
    double squared    = 0.;
    for (const double indicator : result.indicators)
      squared += indicator;
    const double factor = squared > 0. ? 1. + correction.missing / squared : 1.;
    for (double &indicator : result.indicators)
      indicator = std::sqrt(std::max(0., factor * indicator));
    result.global = compare::root_of_squares(result.indicators);
    return result;
  }
} // namespace tetradapt::estimate
