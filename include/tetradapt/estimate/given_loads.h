// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_given_loads_h
#define tetradapt_estimate_given_loads_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mechanics/springs.h"
#include "tetradapt/mechanics/surface_loads.h"
#include "tetradapt/mechanics/volume_density.h"

namespace tetradapt::estimate
{
  using dealii::Point;
  using dealii::Tensor;

  /**
   * What a scene's loads and supports say about the stress that they cause:
   * sigma n = t on the boundary, where a component of the displacement is free, and
   * div sigma + f = 0 inside. Springs, where a displacement is given, count as the tractions that
   * they have at it. Loads are evaluated where they are asked for, so that
   * estimators can take them at points of their own.
   */
  class GivenLoads
  {
  public:
    /** Keeps references to the mesh and the materials.
     * @throws core::InputError if an expression of a load does not compile. */
    GivenLoads(const scene::Scene           &scene,
               const mechanics::MaterialMap &materials,
               const mesh::TetMesh          &mesh);

    /** The same with the tractions of the springs at @p displacement, on its mesh. Keeps a
     * reference to it. */
    GivenLoads(const scene::Scene           &scene,
               const mechanics::MaterialMap &materials,
               const mesh::NodalField       &displacement);

    /** Bit c is set if a support holds displacement component c on boundary face
     * @p face. A face that is coupled rigidly has all, and one that slides those that other
     * supports hold. */
    unsigned char
    held_components(unsigned int face) const
    {
      return patches[mesh.faces[face].patch].held;
    }

    /** Bit c is set if component c of the traction on boundary face @p face is
     * known: not held by a support, and no nodal force there, which is no traction. None where the
     * face slides: see known_directions(). */
    unsigned char
    known_components(unsigned int face) const
    {
      return patches[mesh.faces[face].patch].known;
    }

    /** Whether boundary face @p face slides along itself, so that the traction is known in its
     * tangential directions. */
    bool
    slides(unsigned int face) const
    {
      return patches[mesh.faces[face].patch].slides;
    }

    /** Orthonormal directions in which the traction is known on a face that slides.
     * @param normal of the face or of the true surface. */
    std::vector<Tensor<1, 3>>
    known_directions(unsigned int face, const Tensor<1, 3> &normal) const;

    /** Whether a traction, pressure or spring acts on boundary face @p face. */
    bool
    has_traction(unsigned int face) const
    {
      return !surface_loads.on_face(face).empty() || (springs && springs->act_on(face));
    }

    /** Sum of the tractions, pressures and springs on boundary face @p face, force per area, as
     * they load the discrete problem; zero on a free face. Valid for the known components.
     * @param point on the face; nx, ny, nz are those of the true surface over it.
     * @param normal of the face, outward, of length one, for pressures. */
    Tensor<1, 3>
    traction(unsigned int face, const Point<3> &point, const Tensor<1, 3> &normal) const;

    /** The same on the true surface of the body, at a point over boundary face @p face. */
    Tensor<1, 3>
    surface_traction(unsigned int face, const mesh::SurfacePoint &at) const;

    /** The body's surface; made when it is first asked for. Not collective. */
    const mesh::TrueSurface &
    surface() const
    {
      return surface_loads.surface();
    }

    /** Calls @p visit(barycentric coordinates, weight, traction) for the points with which the
     * tractions and pressures on boundary face @p face are integrated. The weights of each load
     * sum to one; several loads have points of their own. */
    template <typename Visitor>
    void
    sample_face(unsigned int face, const Visitor &visit) const;

    /** The same for the body forces in @p cell. */
    template <typename Visitor>
    void
    sample_cell(unsigned int cell, const Visitor &visit) const;

    /** Points and weights that are good for functions of the tractions and pressures on a face,
     * such as the square of what a stress misses: those of the load that needs most. The values
     * are that load's only. Valid until the next call. */
    const mechanics::SurfaceLoads::Samples &
    face_points(unsigned int face) const;

    /** The same for the body forces in a cell. */
    const mechanics::VolumeDensity::Samples &
    cell_points(unsigned int cell) const;

    /** Whether the tractions and pressures on a face are the same at all of its points. */
    bool
    is_constant_on(unsigned int face) const;

    /** Whether the body forces in a cell are the same at all of its points. */
    bool
    is_constant_in(unsigned int cell) const;

    /** Whether a body force or weight acts anywhere. */
    bool
    has_body_force() const
    {
      return !materials.body_forces().empty();
    }

    /** Sum of the body forces and the weight at a point of @p cell, force per volume. */
    Tensor<1, 3>
    body_force(unsigned int cell, const Point<3> &point) const;

  private:
    struct PatchConditions
    {
      unsigned char held = 0, known = 7;
      bool          slides = false, has_nodal_forces = false;
    };

    /** The displacement that springs act at, at a point of a face or over it. */
    Tensor<1, 3>
    displacement_at(unsigned int face, const Point<3> &point) const;
    Tensor<1, 3>
    displacement_at(unsigned int face, const std::array<double, 3> &b) const;

    const mesh::TetMesh                      &mesh;
    const mechanics::MaterialMap             &materials;
    mechanics::SurfaceLoads                   surface_loads;
    const mesh::NodalField                   *displacement = nullptr;
    std::unique_ptr<mechanics::Springs>       springs;    ///< null: none, or not asked for
    std::vector<std::array<unsigned int, 6>>  face_nodes; ///< where there are springs
    std::vector<PatchConditions>              patches;    ///< as TetMesh::patches
    mutable mechanics::SurfaceLoads::Samples  face_samples, most_on_face; ///< work space
    mutable mechanics::VolumeDensity::Samples cell_samples, most_in_cell;
  };

  template <typename Visitor>
  void
  GivenLoads::sample_face(const unsigned int face, const Visitor &visit) const
  {
    for (const unsigned int load : surface_loads.on_face(face))
      {
        surface_loads.sample(load, face, face_samples);
        for (const auto &point : face_samples)
          visit(point.b, point.weight, point.value);
      }
    if (!springs)
      return;
    const double area       = mesh::face_area_vector(mesh, mesh.faces[face]).norm();
    const auto [begin, end] = springs->on_face(face);
    for (auto spring = begin; spring != end; ++spring)
      for (const auto &point : spring->points)
        visit(point.b, point.weight / area, point.traction(displacement_at(face, point.b)));
  }

  template <typename Visitor>
  void
  GivenLoads::sample_cell(const unsigned int cell, const Visitor &visit) const
  {
    for (const auto &force : materials.body_forces())
      if (force.second->acts_in(mesh.regions[cell]))
        {
          force.second->sample(mesh, cell, cell_samples);
          for (const auto &point : cell_samples)
            visit(point.b, point.weight, point.value);
        }
  }
} // namespace tetradapt::estimate

#endif
