// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/chebyshev.h"
#include "tetradapt/solve/preconditioners.h"

#include "flat_correction.h"

namespace tetradapt::solve
{
  namespace
  {
    constexpr unsigned int usual_degree = 3; ///< of the smoother

    /** The inverses of a matrix's own blocks; zero at coupled nodes, which so stay at zero. */
    template <typename Number>
    std::vector<std::array<Number, 9>>
    smoothed_blocks(const mechanics::MatrixFreeStiffness<Number> &matrix,
                    const mechanics::RigidCouplings              *couplings)
    {
      auto inverses = invert_blocks<Number, 3>(matrix.diagonal_blocks());
      if (couplings != nullptr)
        for (const auto &node : couplings->nodes())
          if (node.local < inverses.size())
            inverses[node.local].fill(0);
      return inverses;
    }

    /** Embedding of degree 1 in degree 2, and its transpose. */
    class Transfer
    {
    public:
      Transfer(const fem::Space &fine, const fem::Space &coarse, const fem::FixedUnknowns &fixed)
        : parents(fine.n_owned_nodes()), components(fine.n_owned_nodes()),
          inclined(fixed.inclined())
      {
        const unsigned int n_points = fine.tet_mesh().n_points();
        for (unsigned int node = 0; node < fine.n_owned_nodes(); ++node)
          {
            const unsigned int field_node = fine.field_node(node);
            components[node]              = fixed.components(node);
            if (field_node < n_points)
              parents[node].fill(coarse.local_node(field_node));
            else
              for (unsigned int i = 0; i < 2; ++i)
                parents[node][i]
                  = coarse.local_node(fine.edge_table()->edges[field_node - n_points][i]);
          }
      }

      template <typename Number>
      void
      add_prolongated(VectorOf<Number> &fine, const VectorOf<Number> &coarse) const
      {
        coarse.update_ghost_values();
        const Number *const x    = coarse.begin();
        Number             *y    = fine.begin();
        auto                next = inclined.begin();
        for (unsigned int node = 0; node < parents.size(); ++node, y += 3)
          {
            Number value[3];
            for (unsigned int c = 0; c < 3; ++c)
              value[c] = Number(0.5) * (x[3 * parents[node][0] + c] + x[3 * parents[node][1] + c]);
            if (components[node] == fem::FixedUnknowns::is_inclined)
              release(*next++, value);
            for (unsigned int c = 0; c < 3; ++c)
              if ((components[node] >> c & 1) == 0)
                y[c] += value[c];
          }
        coarse.zero_out_ghost_values();
      }

      /** coarse = P^T (b - product). */
      template <typename Number>
      void
      restrict_residual(VectorOf<Number>       &coarse,
                        const VectorOf<Number> &b,
                        const VectorOf<Number> &product) const
      {
        coarse             = Number(0);
        Number *const y    = coarse.begin();
        const Number *from = b.begin(), *less = product.begin();
        auto          next = inclined.begin();
        for (unsigned int node = 0; node < parents.size(); ++node, from += 3, less += 3)
          {
            Number half[3];
            for (unsigned int c = 0; c < 3; ++c)
              half[c] = Number(0.5) * (from[c] - less[c]);
            if (components[node] == fem::FixedUnknowns::is_inclined)
              release(*next++, half);
            for (unsigned int c = 0; c < 3; ++c)
              if ((components[node] >> c & 1) == 0)
                {
                  y[3 * parents[node][0] + c] += half[c];
                  y[3 * parents[node][1] + c] += half[c];
                }
          }
        coarse.compress(dealii::VectorOperation::add);
      }

    private:
      /** Takes from a node's values what is held. */
      template <typename Number>
      static void
      release(const fem::InclinedNode &node, Number *values)
      {
        dealii::Tensor<1, 3> x;
        for (unsigned int c = 0; c < 3; ++c)
          x[c] = values[c];
        x -= node.held * x;
        for (unsigned int c = 0; c < 3; ++c)
          values[c] = static_cast<Number>(x[c]);
      }

      std::vector<std::array<unsigned int, 2>> parents;    ///< local nodes of the coarse space
      std::vector<unsigned char>               components; ///< that are fixed
      std::vector<fem::InclinedNode>           inclined;   ///< of the fine space
    };

    template <typename Number>
    class PMultigrid : public ApproximateInverse<Number>
    {
    public:
      using Matrix = mechanics::MatrixFreeStiffness<Number>;

      PMultigrid(std::unique_ptr<Matrix>                     fine,
                 const fem::Space                           &fine_space,
                 const fem::Space                           &coarse_space,
                 const fem::FixedUnknowns                   &fixed,
                 std::unique_ptr<ApproximateInverse<Number>> coarse,
                 std::unique_ptr<FlatCorrection<Number>>     flat_correction,
                 const mechanics::RigidCouplings            *couplings)
        : matrix(std::move(fine)), transfer(fine_space, coarse_space, fixed),
          coarse_solver(std::move(coarse)), flat(std::move(flat_correction)),
          smoother(*matrix,
                   smoothed_blocks(*matrix, couplings),
                   usual_degree,
                   flat != nullptr ? &flat->blocks() : nullptr)
      {
        product.reinit(fine_space.vector_layout());
        coarse_residual.reinit(coarse_space.vector_layout());
        coarse_correction.reinit(coarse_space.vector_layout());
      }

      void
      vmult(VectorOf<Number> &destination, const VectorOf<Number> &source) const override
      {
        smoother.start(destination, source);
        correct(destination, source);
        if (flat != nullptr)
          {
            matrix->vmult(product, destination);
            product.sadd(-1, 1, source);
            flat->correct(product, destination);
            correct(destination, source); // twice, for symmetry
          }
        smoother.step(destination, source);
      }

      void
      set_smoother_degree(const unsigned int degree) override
      {
        smoother.set_degree(degree);
      }

    private:
      /** Adds the correction of degree 1 for the residual of @p x. */
      void
      correct(VectorOf<Number> &x, const VectorOf<Number> &b) const
      {
        matrix->vmult(product, x);
        transfer.restrict_residual(coarse_residual, b, product);
        coarse_solver->vmult(coarse_correction, coarse_residual);
        transfer.add_prolongated(x, coarse_correction);
      }

      std::unique_ptr<Matrix>                     matrix;
      Transfer                                    transfer;
      std::unique_ptr<ApproximateInverse<Number>> coarse_solver;
      std::unique_ptr<FlatCorrection<Number>>     flat; ///< may be null
      ChebyshevSmoother<Number, 3>                smoother;
      mutable VectorOf<Number>                    product, coarse_residual, coarse_correction;
    };
  } // namespace

  template <typename Number>
  std::unique_ptr<ApproximateInverse<Number>>
  make_p_multigrid(std::unique_ptr<mechanics::MatrixFreeStiffness<Number>> fine,
                   const fem::Space                                       &fine_space,
                   const fem::Space                                       &coarse_space,
                   const fem::FixedUnknowns                               &fixed,
                   std::unique_ptr<ApproximateInverse<Number>>             coarse_solver,
                   std::unique_ptr<FlatCorrection<Number>>                 flat,
                   const mechanics::RigidCouplings                        *couplings)
  {
    return std::make_unique<PMultigrid<Number>>(std::move(fine),
                                                fine_space,
                                                coarse_space,
                                                fixed,
                                                std::move(coarse_solver),
                                                std::move(flat),
                                                couplings);
  }

  template std::unique_ptr<ApproximateInverse<float>>
  make_p_multigrid(std::unique_ptr<mechanics::MatrixFreeStiffness<float>>,
                   const fem::Space &,
                   const fem::Space &,
                   const fem::FixedUnknowns &,
                   std::unique_ptr<ApproximateInverse<float>>,
                   std::unique_ptr<FlatCorrection<float>>,
                   const mechanics::RigidCouplings *);
  template std::unique_ptr<ApproximateInverse<double>>
  make_p_multigrid(std::unique_ptr<mechanics::MatrixFreeStiffness<double>>,
                   const fem::Space &,
                   const fem::Space &,
                   const fem::FixedUnknowns &,
                   std::unique_ptr<ApproximateInverse<double>>,
                   std::unique_ptr<FlatCorrection<double>>,
                   const mechanics::RigidCouplings *);
} // namespace tetradapt::solve
