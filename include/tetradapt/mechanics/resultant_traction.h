// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_resultant_traction_h
#define tetradapt_mechanics_resultant_traction_h

#include "tetradapt/mechanics/density_sampler.h"
#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/mesh/true_surface.h"
#include "tetradapt/scene/model_parameters.h"

#include <string>
#include <vector>

namespace tetradapt::mechanics
{
  /**
   * A traction on some faces of a mesh whose resultant is what a scene gives
   * (scene::LoadType::total_force), again on each mesh:
   *
   *     t = a + b x (x - c) - k max(0, -n . d) m
   *
   * with the faces' centroid c, the outward unit normals n of the body's surface and m of the face,
   * and constants a, b, d and k.
   */
  class ResultantTraction
  {
  public:
    using Sampler = DensitySampler<3>;

    /**
     * Distribution::even, without k: a = F / A, and b solves I b = M + (p - c) x F with the second
     * moments of area I = int |x - c|^2 1 - (x - c) (x - c)^T, so that the resultant force is F and
     * the moment about p is M. Of all tractions with this resultant it has the smallest mean
     * square. The integrals over the flat faces are exact.
     *
     * @param load F is its value, p its point About, by default c.
     * @param faces numbers of boundary faces.
     * @throws core::InputError if there is a moment about c and the faces are all so near one
     *         line that they cannot carry it.
     */
    static ResultantTraction
    even(const scene::LoadParameters     &load,
         const mesh::TetMesh             &mesh,
         const std::vector<unsigned int> &faces);

    /**
     * Distribution::bearing, a pin that presses in the direction d of the force F, without b: k
     * makes the force along d that of F, and a, across d, removes what an unsymmetric selection
     * leaves there.
     *
     * @param surface of the body.
     * @throws core::InputError if the force presses on none of the faces.
     */
    static ResultantTraction
    bearing(const scene::LoadParameters     &load,
            const mesh::TetMesh             &mesh,
            const std::vector<unsigned int> &faces,
            const mesh::TrueSurface         &surface,
            const Sampler                   &sampler);

    /**
     * The traction at a point.
     * @param n the outward unit normal of the body's surface there.
     * @param m that of the face that is integrated over.
     */
    Tensor<1, 3>
    value(const Point<3> &point, const Tensor<1, 3> &n, const Tensor<1, 3> &m) const;

    /** Whether it is the same everywhere. */
    bool
    is_constant() const
    {
      return !is_bearing && rotation == Tensor<1, 3>();
    }

    /** Whether it depends on the normals; if not, it is linear in the position. */
    bool
    uses_normal() const
    {
      return is_bearing;
    }

    /**
     * Replaces @p samples by points of a face and the traction of a bearing there: by those that
     * it was fitted with, so that its force is exact up to rounding.
     * @return an estimate of the remaining error of the mean traction on the face.
     */
    double
    sample_bearing(const mesh::TetMesh     &mesh,
                   unsigned int             face,
                   const mesh::TrueSurface &surface,
                   const Sampler           &sampler,
                   Sampler::Samples        &samples) const;

    /** Empty, or a sentence about what had to be added across a bearing's force. */
    std::string
    note() const
    {
      return added;
    }

  private:
    /** -max(0, -n . d) m */
    Tensor<1, 3>
    shape(const Tensor<1, 3> &n, const Tensor<1, 3> &m) const;

    bool         is_bearing = false;
    Tensor<1, 3> constant;              ///< a
    Tensor<1, 3> rotation;              ///< b
    Point<3>     centroid;              ///< c
    Tensor<1, 3> direction;             ///< d
    double       largest_pressure = 0.; ///< k
    std::string  added;
  };
} // namespace tetradapt::mechanics

#endif
