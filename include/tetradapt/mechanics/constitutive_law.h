// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_constitutive_law_h
#define tetradapt_mechanics_constitutive_law_h

#include "tetradapt/scene/model_parameters.h"

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tetradapt::mechanics
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  /**
   * An isotropic linear law written with a pressure as an unknown of its own, which carries
   * what Lame's lambda exceeds a moderate gamma by: p = -(lambda - gamma) tr(strain), so that
   * stress = 2 mu strain + gamma tr(strain) I - p I, where p / (lambda - gamma) + tr(strain) = 0
   * holds weakly. The part with gamma makes the equations easier to solve ("grad-div
   * stabilisation"; see doc/mixed_form.md).
   */
  struct PressureForm
  {
    double shear_modulus; ///< mu
    double kept_lambda;   ///< gamma, positive and below lambda
    double inverse_rest;  ///< 1 / (lambda - gamma) with lambda the first Lame parameter;
                          ///< 0: incompressible

    /** Stress at displacement gradient @p G, or of a strain, and pressure @p p. */
    SymmetricTensor<2, 3>
    stress(const Tensor<2, 3> &G, double p) const
    {
      return 2. * shear_modulus * symmetrize(G)
             + (kept_lambda * trace(G) - p) * dealii::unit_symmetric_tensor<3>();
    }
  };

  /**
   * A constitutive law: stress and tangent at one point, from the displacement
   * gradient G = du/dx there. Assembly, estimators and output know laws only
   * through this interface; see make_law() for adding one.
   */
  class ConstitutiveLaw
  {
  public:
    virtual ~ConstitutiveLaw() = default;

    /** Whether stress() is a linear function of G, so that one linear solve
     * suffices and tangent() is the same everywhere. */
    virtual bool
    is_linear() const = 0;

    /** Cauchy stress at displacement gradient @p G, without thermal strain. */
    virtual SymmetricTensor<2, 3>
    stress(const Tensor<2, 3> &G) const = 0;

    /** Derivative of the stress with respect to the strain at @p G. */
    virtual SymmetricTensor<4, 3>
    tangent(const Tensor<2, 3> &G) const = 0;

    /** strain : C : strain with C the tangent at rest, the density of the energy
     * norm's square. */
    virtual double
    energy_density(const SymmetricTensor<2, 3> &strain) const = 0;

    /** stress : C^-1 : stress with C the tangent at rest. */
    virtual double
    complementary_density(const SymmetricTensor<2, 3> &stress) const = 0;

    /** The law for the mixed form; empty if it has none. */
    virtual std::optional<PressureForm>
    pressure_form() const
    {
      return std::nullopt;
    }
  };

  /**
   * Makes the law that @p parameters names.
   * @throws InputError listing the valid names for an unknown one.
   */
  std::unique_ptr<ConstitutiveLaw>
  make_law(const scene::MaterialParameters &parameters);

  /**
   * Refuses a law that one linear solve cannot deal with: it would be solved with its
   * tangent at rest, which is another problem, without a word.
   * @param material names the material in the message.
   * @throws core::InputError if the law is not linear.
   */
  void
  require_linear(const ConstitutiveLaw &law, const scene::MaterialParameters &material);

  /** Names that make_law() knows. */
  std::vector<std::string>
  law_names();
} // namespace tetradapt::mechanics

#endif
