// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/exceptions.h"
#include "tetradapt/solve/preconditioners.h"
#include "tetradapt/solve/trilinos_types.h"

#include "rigid_modes.h"

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

#include <cmath>
#include <string>
#include <type_traits>

namespace tetradapt::solve
{
  namespace
  {
    /** What Trilinos numbers rows with. */
    using GlobalIndex
      = std::conditional_t<sizeof(dealii::types::global_dof_index) == 8, long long, int>;

    /** Throws if a function of Trilinos failed; positive numbers are remarks. */
    void
    check(const int code)
    {
      if (code < 0)
        throw core::NumericalError("Trilinos could not make a matrix: error " + std::to_string(code)
                                   + ".");
    }

    /** The same matrix with an entry for each unknown. Supports are built in already. */
    std::unique_ptr<Epetra_CrsMatrix>
    copy(const mechanics::BlockMatrix &matrix)
    {
      const auto      &layout = *matrix.vector_layout();
      const Epetra_Map rows
        = layout.locally_owned_range().make_trilinos_map(layout.get_mpi_communicator(), false);
      std::vector<int> lengths(3 * matrix.n_rows());
      for (unsigned int i = 0; i < lengths.size(); ++i)
        lengths[i] = 3 * static_cast<int>(matrix.row_end(i / 3) - matrix.row_begin(i / 3));
      auto result = std::make_unique<Epetra_CrsMatrix>(Copy, rows, lengths.data(), true);

      std::vector<GlobalIndex> columns;
      std::vector<double>      values;
      for (unsigned int i = 0; i < lengths.size(); ++i)
        {
          columns.clear();
          values.clear();
          for (std::size_t k = matrix.row_begin(i / 3); k < matrix.row_end(i / 3); ++k)
            for (unsigned int j = 0; j < 3; ++j)
              {
                const double value = matrix.block(k)[3 * (i % 3) + j];
                if (value == 0.) // as next to a fixed unknown
                  continue;
                columns.push_back(layout.local_to_global(3 * matrix.column(k) + j));
                values.push_back(value);
              }
          const GlobalIndex row = layout.local_to_global(i);
          check(result->InsertGlobalValues(
            row, static_cast<int>(columns.size()), values.data(), columns.data()));
        }
      check(result->FillComplete());
      return result;
    }

    std::unique_ptr<MultiVector>
    columns_of(const std::vector<NodeModes<3>> &modes, const Epetra_Map &rows)
    {
      auto result = std::make_unique<MultiVector>(rows, 6);
      for (unsigned int node = 0; node < modes.size(); ++node)
        for (unsigned int k = 0; k < 6; ++k)
          for (unsigned int c = 0; c < 3; ++c)
            (*result)[k][3 * node + c] = modes[node][6 * c + k];
      return result;
    }

    class TrilinosAmg : public Preconditioner
    {
    public:
      TrilinosAmg(const mechanics::BlockMatrix &blocks, const std::vector<NodeModes<3>> &motions)
        : matrix(copy(blocks)), modes(columns_of(motions, matrix->RowMap()))
      {
        const double size = matrix->NormInf();
        if (!std::isfinite(size))
          throw core::NumericalError("The stiffness matrix has entries that are not finite. Look "
                                     "at the material constants.");
        Teuchos::ParameterList parameters;
        ML_Epetra::SetDefaults("SA", parameters);
        parameters.set("ML output", 0);
        parameters.set("PDE equations", 3);
        parameters.set("smoother: type", "Chebyshev");
        parameters.set("smoother: sweeps", 2);
        parameters.set("smoother: Chebyshev alpha", 20.);
        parameters.set("coarse: max size", 1000);
        parameters.set("coarse: type", "Amesos-KLU");
        parameters.set("coarse: add to diag", 1e-14 * size);
        parameters.set("ML validate parameter list", false);
        parameters.set("aggregation: type", "Uncoupled");
        parameters.set("null space: type", "pre-computed");
        parameters.set("null space: dimension", modes->NumVectors());
        parameters.set("null space: vectors", modes->Values());
        amg.initialize(*matrix, parameters);
      }

      void
      vmult(Vector &destination, const Vector &source) const override
      {
        amg.vmult(destination, source);
      }

    private:
      std::unique_ptr<Epetra_CrsMatrix> matrix;
      std::unique_ptr<MultiVector>      modes; ///< ML keeps a pointer to it
      AmgPreconditioner                 amg;
    };
  } // namespace

  std::unique_ptr<Preconditioner>
  make_trilinos_amg(const mechanics::BlockMatrix &matrix,
                    const fem::Space             &space,
                    const fem::FixedUnknowns     &fixed)
  {
    return std::make_unique<TrilinosAmg>(matrix, rigid_modes(space, fixed));
  }
} // namespace tetradapt::solve
