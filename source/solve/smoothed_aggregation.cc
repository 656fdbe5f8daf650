// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/preconditioners.h"

#include "aggregate_levels.h"
#include "rigid_modes.h"

namespace tetradapt::solve
{
  namespace
  {
    constexpr unsigned int smoother_degree = 2;
    /** Of the prolongation, in units of the inverse of the largest eigenvalue. */
    constexpr double damping = 1.45;
    /** Couplings that aggregates follow, relative to the largest: supports of smoothed
     * prolongations overlap far and weakly on the coarser levels. */
    constexpr double fine_threshold = 0.1, coarse_threshold = 0.25;

    /** The finest level may be rounded: the cycle is positive as long as the levels below
     * are, which are in double precision. */
    template <typename Number>
    class SmoothedAggregation : public ApproximateInverse<Number>
    {
    public:
      SmoothedAggregation(const BlockRows<3, 3>           &rows,
                          const std::vector<NodeModes<3>> &modes,
                          const Layout                    &layout,
                          double                           scale,
                          const RigidAggregates           *rigid = nullptr)
        : fine(rows, layout, smoother_degree, scale, rigid)
      {
        auto coarsening
          = coarsen(rows,
                    modes,
                    layout,
                    aggregate(rigid == nullptr ? rows : rigid->without_couplings(rows),
                              fine_threshold),
                    {damping / fine.smoother.largest_eigenvalue()},
                    0.,
                    rigid);
        if (!coarsening)
          return;
        fine.prolongation = Prolongation<Number, 3>(coarsening->prolongation);
        for (auto &block : coarsening->coarse.rows.blocks)
          for (double &entry : block)
            entry *= scale;
        const auto by_threshold
          = [](const BlockRows<6, 6> &matrix) { return aggregate(matrix, coarse_threshold); };
        below.emplace(std::move(coarsening->coarse),
                      LevelRule{by_threshold, {damping}, {damping}, smoother_degree});
      }

      void
      vmult(VectorOf<Number> &destination, const VectorOf<Number> &source) const override
      {
        fine.smoother.start(destination, source);
        if (below)
          {
            fine.matrix.vmult(fine.residual, destination);
            fine.residual.sadd(-1, 1, source);
            below->correct(fine.prolongation, fine.residual, destination);
          }
        fine.smoother.step(destination, source);
      }

    private:
      Level<Number, 3>               fine;
      std::optional<AggregateLevels> below;
    };
  } // namespace

  template <typename Number>
  std::unique_ptr<ApproximateInverse<Number>>
  make_amg(const mechanics::BlockMatrix    &matrix,
           const fem::Space                &space,
           const fem::FixedUnknowns        &fixed,
           const double                     scale,
           const mechanics::RigidCouplings *couplings)
  {
    std::unique_ptr<RigidAggregates> rigid;
    if (couplings != nullptr && !couplings->empty())
      rigid = std::make_unique<RigidAggregates>(*couplings, space);
    return std::make_unique<SmoothedAggregation<Number>>(
      matrix.rows(), rigid_modes(space, fixed), space.vector_layout(), scale, rigid.get());
  }

  std::unique_ptr<Preconditioner>
  make_amg(const BlockRows<3, 3>                                            &rows,
           const std::vector<NodeModes<3>>                                  &modes,
           const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout)
  {
    return std::make_unique<SmoothedAggregation<double>>(rows, modes, layout, 1.);
  }

  template std::unique_ptr<ApproximateInverse<float>>
  make_amg(const mechanics::BlockMatrix &,
           const fem::Space &,
           const fem::FixedUnknowns &,
           double,
           const mechanics::RigidCouplings *);
  template std::unique_ptr<ApproximateInverse<double>>
  make_amg(const mechanics::BlockMatrix &,
           const fem::Space &,
           const fem::FixedUnknowns &,
           double,
           const mechanics::RigidCouplings *);
} // namespace tetradapt::solve
