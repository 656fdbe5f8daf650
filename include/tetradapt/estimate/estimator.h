// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_estimator_h
#define tetradapt_estimate_estimator_h

#include "tetradapt/estimate/comparison.h"
#include "tetradapt/scene/study_parameters.h"

#include <memory>
#include <string>
#include <vector>

namespace tetradapt::estimate
{
  /** How large the error is, and where. */
  struct Estimate
  {
    std::vector<double> indicators;  ///< eta_K >= 0, one a cell
    double              global = 0.; ///< see Estimator::is_energy_norm()
  };

  /** What an estimator works with: the solution and its comparisons, through
   * which it shares whatever others have computed already. */
  struct EstimateInput
  {
    Comparison &comparison;
  };

  /**
   * Estimates the error of a displacement, per cell and in all. To add one:
   * derive a class, give it a name, and list it in estimator.cc.
   */
  class Estimator
  {
  public:
    virtual ~Estimator() = default;

    /** The name by which make_estimator() finds it. */
    virtual std::string
    name() const = 0;

    /** One or two sentences for the user. */
    virtual std::string
    documentation() const = 0;

    /** Whether it needs a reference solution, so that a scene without any use
     * for one need not solve it. */
    virtual bool
    needs_reference() const = 0;

    /** Whether it needs an exact displacement. */
    virtual bool
    needs_exact_displacement() const = 0;

    /** Whether indicators are energy norms and global the root of the sum of
     * their squares; else the class says what they are. */
    virtual bool
    is_energy_norm() const = 0;

    /** Collective over the comparison's communicator.
     * @throws core::InputError if what it needs is not there. */
    virtual Estimate
    estimate(const EstimateInput &input) const = 0;
  };

  /** "extrapolation energy": the energy norm of the difference to a reference
   * solution on a finer mesh or of higher degree. */
  class ExtrapolationEnergy : public Estimator
  {
  public:
    std::string
    name() const override;
    std::string
    documentation() const override;
    bool
    needs_reference() const override;
    bool
    needs_exact_displacement() const override;
    bool
    is_energy_norm() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };

  /** "extrapolation ren": the 2015 report's estimator. A cell's indicator is the
   * sum of the relative error norms of its nodes against the reference; global is
   * the mean over all nodes. Dimensionless. */
  class ExtrapolationRen : public Estimator
  {
  public:
    std::string
    name() const override;
    std::string
    documentation() const override;
    bool
    needs_reference() const override;
    bool
    needs_exact_displacement() const override;
    bool
    is_energy_norm() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };

  /** "exact energy": the energy norm of the true error, for scenes whose exact
   * displacement is known. */
  class ExactEnergy : public Estimator
  {
  public:
    std::string
    name() const override;
    std::string
    documentation() const override;
    bool
    needs_reference() const override;
    bool
    needs_exact_displacement() const override;
    bool
    is_energy_norm() const override;
    Estimate
    estimate(const EstimateInput &input) const override;
  };

  /** Names that make_estimator() knows. */
  std::vector<std::string>
  estimator_names();

  /** @throws core::InputError listing the valid names for an unknown one. */
  std::unique_ptr<Estimator>
  make_estimator(const std::string &name);

  /** The name of the estimator that @p driver asks for. */
  std::string
  estimator_name(scene::AdaptivityParameters::Driver driver);
} // namespace tetradapt::estimate

#endif
