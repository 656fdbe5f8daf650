// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_surface_loads_h
#define tetradapt_mechanics_surface_loads_h

#include "tetradapt/core/surface_expression.h"
#include "tetradapt/mechanics/density_sampler.h"
#include "tetradapt/mechanics/resultant_traction.h"
#include "tetradapt/mesh/true_surface.h"
#include "tetradapt/scene/scene.h"

#include <map>
#include <memory>

namespace tetradapt::mechanics
{
  /**
   * The tractions, pressures and total forces of a scene on the boundary faces of one mesh: which
   * act on a face, what they are at a point, and how they are integrated. A total force becomes
   * a traction when it is first asked for (ResultantTraction). All that integrates loads
   * or compares stresses with them asks here, so that all take the same.
   *
   * One object is to be used by one thread.
   */
  class SurfaceLoads
  {
  public:
    using Samples = DensitySampler<3>::Samples;

    /** Keeps a reference to the mesh, whose patches name the loads.
     * @throws core::InputError if an expression does not compile. */
    SurfaceLoads(const scene::Scene &scene, const mesh::TetMesh &mesh);

    /** The same for other densities on faces than the scene's loads: the patches name them
     * "section/name", and messages "section/name/parameter". */
    SurfaceLoads(const std::vector<scene::LoadParameters> &densities,
                 const std::string                        &section,
                 const std::string                        &parameter,
                 const scene::MeshParameters              &mesh_parameters,
                 const mesh::TetMesh                      &mesh);
    ~SurfaceLoads();

    /** Numbers, among the scene's loads, of the tractions and pressures on boundary face
     * @p face. */
    const std::vector<unsigned int> &
    on_face(const unsigned int face) const
    {
      return on_patch[mesh.faces[face].patch];
    }

    /** The force per area of load @p load (its number among the scene's) at a point of boundary
     * face @p face, as it loads the discrete problem. nx, ny, nz are those of the true surface
     * over the point. @param normal of the face, outward, of length one, for pressures. */
    Tensor<1, 3>
    traction(unsigned int        load,
             unsigned int        face,
             const Point<3>     &point,
             const Tensor<1, 3> &normal) const;

    /** The same on the true surface of the body, at a point over the face. */
    Tensor<1, 3>
    surface_traction(unsigned int load, const mesh::SurfacePoint &at) const;

    /** Whether load @p load is the same at all points of a flat face. */
    bool
    is_constant(unsigned int load) const;

    /** A constant load's force per area on a flat face. */
    Tensor<1, 3>
    constant_traction(unsigned int load, const Tensor<1, 3> &normal) const;

    /**
     * Replaces @p samples by points of boundary face @p face, with weights that sum to one and
     * the traction of load @p load, for integrals of it times polynomials of degree up to 5.
     * @return an estimate of the remaining error of the mean traction on the face.
     */
    double
    sample(unsigned int load, unsigned int face, Samples &samples) const;

    /** The same, but a load that is constant on the face has one point, the centroid. */
    double
    sample_compactly(unsigned int load, unsigned int face, Samples &samples) const;

    /** The same as sample() for any triangle of the surface, whose outward unit normal is
     * @p normal, also for nx, ny, nz. */
    double
    sample_triangle(unsigned int                   load,
                    const std::array<Point<3>, 3> &corners,
                    const Tensor<1, 3>            &normal,
                    Samples                       &samples) const;

    /** Makes the tractions of all total forces.
     * @throws core::InputError if the faces cannot carry one. */
    void
    check() const;

    /** The body's surface; made when it is first asked for. */
    const mesh::TrueSurface &
    surface() const;

    /** Empty, or how the spacing with which load @p load is looked at differs from the one
     * asked for. */
    std::string
    remark(unsigned int load) const;

    /** Empty, or what had to be added to load @p load; see ResultantTraction::note(). */
    std::string
    note(unsigned int load) const;

    /** Evaluations that looking at one load on one mesh may take: the spacing is as large as that
     * needs. About as many may be spent on jumps and peaks. */
    static constexpr double most_evaluations = 4e6;

  private:
    struct Load;

    /** Finds how large a load is and where it varies. */
    void
    look_at(const Load &load, unsigned int number) const;
    double
    sample_carefully(const Load                        &load,
                     unsigned int                       number,
                     const std::array<Point<3>, 3>     &corners,
                     const DensitySampler<3>::Function &density,
                     Samples                           &samples) const;
    std::array<Point<3>, 3>
    corners_of(unsigned int face) const;
    std::vector<unsigned int>
    faces_of(unsigned int number) const;
    /** The traction of a total force, made when it is first asked for; null for other loads. */
    const ResultantTraction *
    resultant(unsigned int number) const;

    const mesh::TetMesh                          &mesh;
    scene::MeshParameters                         mesh_parameters; ///< for the surface
    std::map<unsigned int, std::unique_ptr<Load>> loads;
    std::vector<std::vector<unsigned int>>        on_patch;
    DensitySampler<3>                             sampler;
    mutable std::unique_ptr<mesh::TrueSurface>    true_surface;
  };
} // namespace tetradapt::mechanics

#endif
