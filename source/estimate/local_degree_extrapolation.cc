// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/cell_stress.h"
#include "tetradapt/compare/stress_difference.h"
#include "tetradapt/estimate/enriched_problem.h"
#include "tetradapt/estimate/extrapolation.h"
#include "tetradapt/solve/conjugate_gradients.h"

namespace tetradapt::estimate
{
  namespace
  {
    using Values = EnrichedSpace::Values;

    /** Blocks a(phi_i, phi_i) of components, row by row, of the functions of degree p at the
     * nodes. As a preconditioner needs no more, every law is taken for an isotropic one. */
    Values
    nodal_diagonal(const mesh::NodalField &u_h, const compare::CellMaterials &materials)
    {
      const mesh::TetMesh &mesh = u_h.mesh();
      Values               blocks(9 * std::size_t(u_h.n_nodes()), 0.);
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        {
          const double mu = materials[cell].shear_modulus, lambda = materials[cell].stiffness[0][1];
          const auto   g      = mesh::barycentric_gradients(mesh, cell);
          const double volume = mesh::cell_volume(mesh, cell);
          // factor times (lambda a b^T + mu b a^T + mu a.b I)
          const auto add = [&](const unsigned int  node,
                               const double        factor,
                               const Tensor<1, 3> &a,
                               const Tensor<1, 3> &b) {
            double *block = &blocks[9 * std::size_t(node)];
            for (unsigned int i = 0; i < 3; ++i)
              {
                block[4 * i] += factor * mu * (a * b);
                for (unsigned int j = 0; j < 3; ++j)
                  block[3 * i + j] += factor * (lambda * a[i] * b[j] + mu * b[i] * a[j]);
              }
          };
          // Degree 2: grad b_i (2 b_i - 1) = (4 b_i - 1) g_i, grad 4 b_i b_j = 4 (b_i g_j + b_j
          // g_i); the integrals of b_i^2 and b_i b_j over the volume are 1/10 and 1/20.
          for (unsigned int i = 0; i < 4; ++i)
            add(u_h.node(cell, i), (u_h.degree() == 1 ? 1. : 0.6) * volume, g[i], g[i]);
          if (u_h.degree() == 2)
            for (unsigned int e = 0; e < 6; ++e)
              {
                const auto &[i, j]      = mesh::edge_vertices[e];
                const unsigned int node = u_h.node(cell, 4 + e);
                add(node, 1.6 * volume, g[i], g[i]);
                add(node, 1.6 * volume, g[j], g[j]);
                add(node, 0.8 * volume, g[i], g[j]);
                add(node, 0.8 * volume, g[j], g[i]);
              }
        }
      return blocks;
    }

    /** Inverses of 3x3 blocks in place. A function without any cell has none: zero. */
    void
    invert_blocks(Values &blocks)
    {
      for (std::size_t first = 0; first < blocks.size(); first += 9)
        {
          Tensor<2, 3> block;
          for (unsigned int i = 0; i < 9; ++i)
            block[i / 3][i % 3] = blocks[first + i];
          block = determinant(block) > 0. ? invert(block) : Tensor<2, 3>();
          for (unsigned int i = 0; i < 9; ++i)
            blocks[first + i] = block[i / 3][i % 3];
        }
    }

    double
    product(const Values &a, const Values &b)
    {
      double sum = 0.;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
      return sum;
    }

    /** What some steps of conjugate gradients found, and the square of the energy norm
     * that they are estimated to have left over. */
    struct RoughCorrection
    {
      Values values;
      double missing = 0.;
    };

    RoughCorrection
    correct(const EnrichedProblem &problem, Values residual, const Values &block_inverses)
    {
      constexpr unsigned int most_steps = 8;
      /** Of what has been found, in squares: 2 % in the norm. */
      constexpr double small = 0.04;

      RoughCorrection            result;
      Values                     preconditioned(residual.size()), direction, stiff;
      solve::EnergyErrorEstimate estimate;
      double                     energy = 0., found = 0.;
      result.values.assign(residual.size(), 0.);
      for (unsigned int step = 0; step < most_steps; ++step)
        {
          for (std::size_t k = 0, block = 0; k < residual.size(); k += 3, block += 9)
            for (unsigned int c = 0; c < 3; ++c)
              preconditioned[k + c] = block_inverses[block + 3 * c] * residual[k]
                                      + block_inverses[block + 3 * c + 1] * residual[k + 1]
                                      + block_inverses[block + 3 * c + 2] * residual[k + 2];
          problem.clear_supported(preconditioned);
          const double before = energy;
          energy              = product(residual, preconditioned);
          if (!(energy > 0.))
            break; // the solution is that of the next degree
          if (step == 0)
            direction = preconditioned;
          else
            for (std::size_t k = 0; k < direction.size(); ++k)
              direction[k] = preconditioned[k] + energy / before * direction[k];
          problem.space().multiply(direction, stiff);
          problem.clear_supported(stiff);
          const double alpha = energy / product(direction, stiff);
          for (std::size_t k = 0; k < direction.size(); ++k)
            {
              result.values[k] += alpha * direction[k];
              residual[k] -= alpha * stiff[k];
            }
          found += alpha * energy;
          estimate.add(alpha * energy);
          result.missing = estimate.squared_error().value_or(0.);
          if (estimate.squared_error() && result.missing <= small * found)
            break;
        }
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
    const mesh::NodalField       &u_h       = *input.solution.displacement;
    const mechanics::MaterialMap &materials = input.comparison.material_map();
    const EnrichedProblem         problem(input.scene,
                                  materials,
                                  input.solution,
                                  input.comparison.mpi_communicator());
    const EnrichedSpace          &space = problem.space();

    Values       blocks  = nodal_diagonal(u_h, compare::CellMaterials(materials, u_h.mesh()));
    const Values surplus = space.surplus_diagonal();
    blocks.insert(blocks.end(), surplus.begin(), surplus.end());
    invert_blocks(blocks);

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
