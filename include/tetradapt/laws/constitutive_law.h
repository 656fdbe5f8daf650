// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_laws_constitutive_law_h
#define tetradapt_laws_constitutive_law_h

#include "tetradapt/laws/constants.h"
#include "tetradapt/laws/formulation.h"

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <optional>

/**
 * Constitutive laws: what happens at one point of a body. No law knows elements, meshes or
 * parameter files; law_catalogue.h says which there are and what parameters they have.
 */
namespace tetradapt::laws
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
   * The derivative A = dP/dF of the first Piola-Kirchhoff stress by the deformation gradient,
   * as the upper triangle, row by row, of a symmetric 9 x 9 matrix whose index of (i, J) is
   * 3 i + J.
   */
  using Tangent = std::array<double, 45>;

  /** The place of entry (a, b) of a Tangent, a <= b < 9. */
  constexpr unsigned int
  tangent_index(unsigned int a, unsigned int b)
  {
    return a * (17 - a) / 2 + b;
  }

  /** What a law answers at a point. */
  struct Response
  {
    double       energy = 0.; ///< stored, per volume of the body at rest
    Tensor<2, 3> stress;      ///< P, first Piola-Kirchhoff: force per area of the body at rest
    Tangent      tangent{};   ///< dP/dF, if it was asked for
  };

  /**
   * The history of a point: as many numbers before and after a step as the law says. A law
   * reads those before and writes those after; it never keeps state of its own, so that one
   * object serves a whole region.
   */
  struct History
  {
    const double *before = nullptr;
    double       *after  = nullptr;
  };

  /** A constitutive law. Every part of the program that does not need more takes laws through
   * this interface. */
  class ConstitutiveLaw
  {
  public:
    virtual ~ConstitutiveLaw() = default;

    /** Whether the law is meant for the formulation. */
    virtual bool
    supports(Formulation formulation) const = 0;

    /** How many numbers of history a point has. */
    virtual unsigned int
    n_history() const
    {
      return 0;
    }

    /**
     * The response to a deformation.
     * @param G the displacement gradient du/dX; the deformation gradient is F = I + G. (Not F
     * itself: that has lost the digits of small strains.) Laws for small strains use the symmetric
     *        part of G, and P is Cauchy's stress then.
     * @param history of the point; may be without arrays if n_history() is 0.
     * @param with_tangent whether Response::tangent is wanted.
     * @return false if the law has no response to this deformation, as where F inverts the
     *         material or numbers leave the range; @p response is undefined then.
     */
    virtual bool
    update(const Tensor<2, 3> &G, History history, bool with_tangent, Response &response) const = 0;

    /** Cauchy's stress, force per deformed area, of the @p response to @p G. */
    virtual SymmetricTensor<2, 3>
    cauchy_stress(const Tensor<2, 3> &G, const Response &response) const = 0;

    /** The derivative of the stress by the strain at rest. */
    virtual SymmetricTensor<4, 3>
    tangent_at_rest() const = 0;

    /** Young's modulus and Poisson's ratio at rest; of an anisotropic law those of the isotropic
     * tensor that is nearest to tangent_at_rest(). */
    virtual ModuliAtRest
    moduli_at_rest() const;
  };

  /** The mean of a law's three shear moduli at rest. */
  double
  shear_modulus(const ConstitutiveLaw &law);

  /**
   * A law whose stress is a linear function of the small strain: one linear solve suffices,
   * the tangent is the same everywhere, and the energy norm of errors is that of the body.
   * Strain is the symmetric part of the displacement gradient G = du/dx.
   */
  class LinearLaw : public ConstitutiveLaw
  {
  public:
    /** Stress at displacement gradient @p G, without thermal strain. */
    virtual SymmetricTensor<2, 3>
    stress(const Tensor<2, 3> &G) const = 0;

    /** strain : C : strain, the density of the energy norm's square. */
    virtual double
    energy_density(const SymmetricTensor<2, 3> &strain) const = 0;

    /** stress : C^-1 : stress. */
    virtual double
    complementary_density(const SymmetricTensor<2, 3> &stress) const = 0;

    /** The law for the mixed form; empty if it has none. */
    virtual std::optional<PressureForm>
    pressure_form() const
    {
      return std::nullopt;
    }

    bool
    update(const Tensor<2, 3> &G,
           History             history,
           bool                with_tangent,
           Response           &response) const override;

    SymmetricTensor<2, 3>
    cauchy_stress(const Tensor<2, 3> &G, const Response &response) const override;
  };
} // namespace tetradapt::laws

#endif
