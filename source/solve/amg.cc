// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/preconditioners.h"
#include "tetradapt/solve/trilinos_types.h"

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

namespace tetradapt::solve
{
  namespace
  {
    class Amg : public Preconditioner
    {
    public:
      Amg(const mechanics::BlockMatrix            &matrix,
          const mechanics::DisplacementSpace      &space,
          const mechanics::PrescribedDisplacement &prescribed)
        : point_matrix(to_point_matrix(matrix, space)),
          modes(rigid_body_modes(*point_matrix, space, prescribed))
      {
        Teuchos::ParameterList parameters;
        ML_Epetra::SetDefaults("SA", parameters);
        parameters.set("ML output", 0);
        parameters.set("PDE equations", 3);
        parameters.set("smoother: type", "Chebyshev");
        parameters.set("smoother: sweeps", 2);
        parameters.set("smoother: Chebyshev alpha", 20.);
        parameters.set("coarse: max size", 1000);
        parameters.set("coarse: type", "Amesos-KLU");
        // ML's own value is not relative to the matrix: it changes those of small entries.
        parameters.set("coarse: add to diag", 1e-14 * point_matrix->NormInf());
        parameters.set("ML validate parameter list", false); // does not know that name
        parameters.set("aggregation: type", "Uncoupled");
        parameters.set("null space: type", "pre-computed");
        parameters.set("null space: dimension", modes->NumVectors());
        parameters.set("null space: vectors", modes->Values());
        amg.initialize(*point_matrix, parameters);
      }

      void
      vmult(Vector &destination, const Vector &source) const override
      {
        amg.vmult(destination, source);
      }

    private:
      std::unique_ptr<PointMatrix> point_matrix;
      std::unique_ptr<MultiVector> modes; ///< ML keeps a pointer to it
      AmgPreconditioner            amg;
    };
  } // namespace

  std::unique_ptr<Preconditioner>
  make_amg(const mechanics::BlockMatrix            &matrix,
           const mechanics::DisplacementSpace      &space,
           const mechanics::PrescribedDisplacement &prescribed)
  {
    return std::make_unique<Amg>(matrix, space, prescribed);
  }
} // namespace tetradapt::solve
