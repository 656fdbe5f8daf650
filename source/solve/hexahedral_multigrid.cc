// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_multigrid.h"

#include "tetradapt/mesh/hexahedral_field.h"

#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    /** Embedding of degree 1 in a higher degree on the same cells, and its transpose. */
    class Transfer
    {
    public:
      Transfer(const HexahedralLevel &fine, const HexahedralLevel &coarse)
        : n_owned(fine.space.n_owned), begin(n_owned + 1, 0)
      {
        std::vector<std::vector<std::pair<unsigned int, double>>> rows(n_owned);
        const auto         along = mesh::hexahedral_nodes(fine.space.degree);
        const unsigned int n     = along.size();
        for (unsigned int cell = 0; cell < fine.forest.cells().size(); ++cell)
          for (unsigned int i = 0; i < fine.space.nodes_per_cell; ++i)
            {
              const unsigned int node = fine.space.nodes(cell)[i];
              if (node >= n_owned || !rows[node].empty())
                continue;
              const double x[3] = {along[i % n], along[i / n % n], along[i / n / n]};
              for (unsigned int v = 0; v < 8; ++v)
                {
                  double shape = 1.;
                  for (unsigned int d = 0; d < 3; ++d)
                    shape *= (v >> d & 1) != 0 ? x[d] : 1. - x[d];
                  if (shape != 0.)
                    coarse.space.expand(coarse.space.nodes(cell)[v],
                                        [&](unsigned int parent, double weight) {
                                          rows[node].emplace_back(parent, shape * weight);
                                        });
                }
            }
        for (unsigned int node = 0; node < n_owned; ++node)
          {
            for (const auto &[parent, weight] : rows[node])
              {
                parents.push_back(parent);
                weights.push_back(weight);
              }
            begin[node + 1] = parents.size();
          }
      }

      void
      add_prolongated(Vector &fine, const Vector &coarse) const
      {
        coarse.update_ghost_values();
        const double *const x = coarse.begin();
        double             *y = fine.begin();
        for (unsigned int node = 0; node < n_owned; ++node, y += 3)
          for (unsigned int k = begin[node]; k < begin[node + 1]; ++k)
            for (unsigned int c = 0; c < 3; ++c)
              y[c] += weights[k] * x[3 * parents[k] + c];
        coarse.zero_out_ghost_values();
      }

      void
      restrict_to(Vector &coarse, const Vector &fine) const
      {
        coarse          = 0.;
        double *const y = coarse.begin();
        const double *x = fine.begin();
        for (unsigned int node = 0; node < n_owned; ++node, x += 3)
          for (unsigned int k = begin[node]; k < begin[node + 1]; ++k)
            for (unsigned int c = 0; c < 3; ++c)
              y[3 * parents[k] + c] += weights[k] * x[c];
        coarse.compress(dealii::VectorOperation::add);
      }

    private:
      unsigned int              n_owned;
      std::vector<unsigned int> begin, parents; ///< local nodes of degree 1
      std::vector<double>       weights;
    };

    class PMultigrid : public Preconditioner
    {
    public:
      PMultigrid(const HexahedralLevel &fine, const HexahedralLevel &coarse)
        : fine(fine), coarse(coarse), transfer(fine, coarse), coarse_solver(make_amg(coarse)),
          inverse_diagonal(fine.stiffness.diagonal())
      {
        for (unsigned int i = 0; i < inverse_diagonal.locally_owned_size(); ++i)
          inverse_diagonal.local_element(i) = 1. / inverse_diagonal.local_element(i);
        fine.supports.set_zero(inverse_diagonal);
        for (Vector *vector : {&residual, &direction, &product})
          vector->reinit(fine.space.layout);
        for (Vector *vector : {&coarse_residual, &coarse_correction})
          vector->reinit(coarse.space.layout);
        find_largest_eigenvalue();
        // Linear functions of a cell are far from those that it has more of.
        sweeps             = fine.space.degree == 2 ? 4 : 6;
        const double range = fine.space.degree == 2 ? 12. : 25.;
        const double from  = largest / range;
        centre             = .5 * (from + largest);
        radius             = .5 * (largest - from);
      }

      void
      vmult(Vector &destination, const Vector &source) const override
      {
        destination = 0.;
        smooth(destination, source, true);
        fine.stiffness.vmult(product, destination);
        residual = source;
        residual -= product;
        fine.supports.set_zero(residual);
        transfer.restrict_to(coarse_residual, residual);
        coarse.supports.set_zero(coarse_residual);
        coarse_solver->vmult(coarse_correction, coarse_residual);
        transfer.add_prolongated(destination, coarse_correction);
        fine.supports.set_zero(destination);
        smooth(destination, source, false);
      }

    private:
      /** Chebyshev's iteration with the diagonal (Saad, Iterative methods, algorithm
       * 12.1). */
      void
      smooth(Vector &x, const Vector &b, bool from_zero) const
      {
        const double sigma = centre / radius;
        double       rho   = 1. / sigma;
        for (unsigned int sweep = 0; sweep < sweeps; ++sweep)
          {
            const bool known = from_zero && sweep == 0;
            if (!known)
              fine.stiffness.vmult(product, x);
            const double new_rho  = sweep == 0 ? rho : 1. / (2. * sigma - rho);
            const double keep     = sweep == 0 ? 0. : rho * new_rho;
            const double add      = sweep == 0 ? 1. / centre : 2. * new_rho / radius;
            rho                   = new_rho;
            const double *const B = b.begin(), *const P = product.begin(),
                                *const D = inverse_diagonal.begin();
            double *const d = direction.begin(), *const X = x.begin();
            for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
              {
                d[i] = (sweep == 0 ? 0. : keep * d[i]) + add * D[i] * (known ? B[i] : B[i] - P[i]);
                X[i] += d[i];
              }
          }
      }

      /** By power iteration, with a little room. */
      void
      find_largest_eigenvalue()
      {
        Vector x(fine.space.layout);
        // Rough, and the same for any distribution over ranks.
        for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
          {
            const unsigned int node  = i / 3 * 3;
            double             phase = i % 3;
            for (unsigned int d = 0; d < 3; ++d)
              phase += 1e3 * (d + 1.3) * fine.positions.local_element(node + d) / length();
            x.local_element(i) = std::sin(phase);
          }
        fine.supports.set_zero(x);
        double norm = x.l2_norm();
        for (unsigned int step = 0; step < 12 && norm > 0.; ++step)
          {
            x *= 1. / norm;
            fine.stiffness.vmult(product, x);
            for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
              x.local_element(i) = inverse_diagonal.local_element(i) * product.local_element(i);
            norm    = x.l2_norm();
            largest = norm;
          }
        largest *= 1.2;
      }

      double
      length() const
      {
        double      result = 0.;
        const auto &planes = fine.forest.grid().planes;
        for (const auto &along : planes)
          result = std::max(result, along.back() - along.front());
        return result;
      }

      const HexahedralLevel          &fine, &coarse;
      Transfer                        transfer;
      std::unique_ptr<Preconditioner> coarse_solver;
      Vector                          inverse_diagonal; ///< zero where prescribed
      unsigned int                    sweeps  = 4;
      double                          largest = 1., centre = 1., radius = 1.;
      mutable Vector residual, direction, product, coarse_residual, coarse_correction;
    };
  } // namespace

  HexahedralLevel::HexahedralLevel(const scene::Scene           &scene,
                                   const mechanics::MaterialMap &materials,
                                   const HexahedralForest       &forest,
                                   const unsigned int            degree)
    : forest(forest), space(forest.number(degree)), stiffness(forest, space, materials),
      positions(node_positions(forest, space)),
      supports(prescribe(scene.supports, forest, space, positions))
  {
  }

  std::unique_ptr<Preconditioner>
  make_p_multigrid(const HexahedralLevel &fine, const HexahedralLevel &coarse)
  {
    return std::make_unique<PMultigrid>(fine, coarse);
  }
} // namespace tetradapt::solve
