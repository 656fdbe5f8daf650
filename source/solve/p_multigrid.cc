// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/preconditioners.h"

#include <deal.II/lac/precondition.h>

namespace tetradapt::solve
{
  namespace
  {
    using mechanics::BlockMatrix;
    using mechanics::DisplacementSpace;

    /** Inverse of a 3x3 block by cofactors. */
    BlockMatrix::Block
    inverse(const BlockMatrix::Block &m)
    {
      const BlockMatrix::Block cofactors{{m[4] * m[8] - m[5] * m[7],
                                          m[2] * m[7] - m[1] * m[8],
                                          m[1] * m[5] - m[2] * m[4],
                                          m[5] * m[6] - m[3] * m[8],
                                          m[0] * m[8] - m[2] * m[6],
                                          m[2] * m[3] - m[0] * m[5],
                                          m[3] * m[7] - m[4] * m[6],
                                          m[1] * m[6] - m[0] * m[7],
                                          m[0] * m[4] - m[1] * m[3]}};
      const double determinant = m[0] * cofactors[0] + m[1] * cofactors[3] + m[2] * cofactors[6];
      BlockMatrix::Block result;
      for (unsigned int i = 0; i < 9; ++i)
        result[i] = cofactors[i] / determinant;
      return result;
    }

    /** Applies the inverse of the 3x3 diagonal block of every node. */
    class BlockJacobi
    {
    public:
      explicit BlockJacobi(const BlockMatrix &matrix) : inverses(matrix.n_rows())
      {
        for (unsigned int row = 0; row < matrix.n_rows(); ++row)
          inverses[row] = inverse(matrix.block(matrix.find(row, row)));
      }

      void
      vmult(Vector &destination, const Vector &source) const
      {
        const double *x = source.begin();
        double       *y = destination.begin();
        for (const auto &b : inverses)
          {
            y[0] = b[0] * x[0] + b[1] * x[1] + b[2] * x[2];
            y[1] = b[3] * x[0] + b[4] * x[1] + b[5] * x[2];
            y[2] = b[6] * x[0] + b[7] * x[1] + b[8] * x[2];
            x += 3;
            y += 3;
          }
      }

    private:
      std::vector<BlockMatrix::Block> inverses;
    };

    /** Embedding of degree 1 in degree 2, and its transpose. */
    class Transfer
    {
    public:
      Transfer(const DisplacementSpace                 &fine,
               const DisplacementSpace                 &coarse,
               const mechanics::PrescribedDisplacement &prescribed)
        : parents(fine.n_owned_nodes()), fixed(fine.n_owned_nodes())
      {
        const unsigned int n_points = fine.tet_mesh().n_points();
        for (unsigned int node = 0; node < fine.n_owned_nodes(); ++node)
          {
            const unsigned int field_node = fine.field_node(node);
            fixed[node]                   = prescribed.fixed[field_node];
            if (field_node < n_points)
              parents[node].fill(coarse.local_node(field_node));
            else
              for (unsigned int i = 0; i < 2; ++i)
                parents[node][i]
                  = coarse.local_node(fine.edge_table()->edges[field_node - n_points][i]);
          }
      }

      void
      add_prolongated(Vector &fine, const Vector &coarse) const
      {
        coarse.update_ghost_values();
        const double *const x = coarse.begin();
        double             *y = fine.begin();
        for (unsigned int node = 0; node < parents.size(); ++node, y += 3)
          for (unsigned int c = 0; c < 3; ++c)
            if ((fixed[node] >> c & 1) == 0)
              y[c] += 0.5 * (x[3 * parents[node][0] + c] + x[3 * parents[node][1] + c]);
        coarse.zero_out_ghost_values();
      }

      void
      restrict_to(Vector &coarse, const Vector &fine) const
      {
        coarse          = 0.;
        double *const y = coarse.begin();
        const double *x = fine.begin();
        for (unsigned int node = 0; node < parents.size(); ++node, x += 3)
          for (unsigned int c = 0; c < 3; ++c)
            if ((fixed[node] >> c & 1) == 0)
              {
                y[3 * parents[node][0] + c] += 0.5 * x[c];
                y[3 * parents[node][1] + c] += 0.5 * x[c];
              }
        coarse.compress(dealii::VectorOperation::add);
      }

    private:
      std::vector<std::array<unsigned int, 2>> parents; ///< local nodes of the coarse space
      std::vector<unsigned char>               fixed;
    };

    class PMultigrid : public Preconditioner
    {
    public:
      PMultigrid(const BlockMatrix                       &fine_matrix,
                 const DisplacementSpace                 &fine_space,
                 const BlockMatrix                       &coarse_matrix,
                 const DisplacementSpace                 &coarse_space,
                 const mechanics::PrescribedDisplacement &prescribed)
        : matrix(fine_matrix), transfer(fine_space, coarse_space, prescribed),
          coarse_solver(make_amg(coarse_matrix, coarse_space, prescribed))
      {
        residual.reinit(fine_space.vector_layout());
        coarse_residual.reinit(coarse_space.vector_layout());
        coarse_correction.reinit(coarse_space.vector_layout());
        Smoother::AdditionalData data;
        data.preconditioner      = std::make_shared<BlockJacobi>(fine_matrix);
        data.degree              = 3;
        data.smoothing_range     = 10.;
        data.eig_cg_n_iterations = 8;
        smoother.initialize(fine_matrix, data);
      }

      void
      vmult(Vector &destination, const Vector &source) const override
      {
        smoother.vmult(destination, source);
        matrix.vmult(residual, destination);
        residual.sadd(-1., 1., source);
        transfer.restrict_to(coarse_residual, residual);
        coarse_solver->vmult(coarse_correction, coarse_residual);
        transfer.add_prolongated(destination, coarse_correction);
        smoother.step(destination, source);
      }

    private:
      using Smoother = dealii::PreconditionChebyshev<BlockMatrix, Vector, BlockJacobi>;

      const BlockMatrix              &matrix;
      Transfer                        transfer;
      std::unique_ptr<Preconditioner> coarse_solver;
      Smoother                        smoother;
      mutable Vector                  residual, coarse_residual, coarse_correction;
    };
  } // namespace

  std::unique_ptr<Preconditioner>
  make_p_multigrid(const BlockMatrix                       &fine_matrix,
                   const DisplacementSpace                 &fine_space,
                   const BlockMatrix                       &coarse_matrix,
                   const DisplacementSpace                 &coarse_space,
                   const mechanics::PrescribedDisplacement &prescribed)
  {
    return std::make_unique<PMultigrid>(
      fine_matrix, fine_space, coarse_matrix, coarse_space, prescribed);
  }
} // namespace tetradapt::solve
