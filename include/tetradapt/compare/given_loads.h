// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_given_loads_h
#define tetradapt_compare_given_loads_h

#include "tetradapt/core/surface_expression.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/true_surface.h"

namespace tetradapt::compare
{
  using dealii::Point;
  using dealii::Tensor;

  /**
   * What a scene's loads and supports say about the stress that they cause:
   * sigma n = t on the boundary, where a component of the displacement is free, and
   * div sigma + f = 0 inside. Loads are evaluated where they are asked for, so that
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

    /** Bit c is set if a support holds displacement component c on boundary face
     * @p face. */
    unsigned char
    held_components(unsigned int face) const
    {
      return patches[mesh.faces[face].patch].held;
    }

    /** Bit c is set if component c of the traction on boundary face @p face is
     * known: not held by a support, and no nodal force there, which is no traction. */
    unsigned char
    known_components(unsigned int face) const
    {
      return patches[mesh.faces[face].patch].known;
    }

    /** Whether a traction or pressure acts on boundary face @p face. */
    bool
    has_traction(unsigned int face) const
    {
      return !patches[mesh.faces[face].patch].loads.empty();
    }

    /** Sum of the tractions and pressures on boundary face @p face, force per area, as they
     * load the discrete problem; zero on a free face. Valid for the known components.
     * @param point on the face; nx, ny, nz are those of the true surface over it.
     * @param normal of the face, outward, of length one, for pressures. */
    Tensor<1, 3>
    traction(unsigned int face, const Point<3> &point, const Tensor<1, 3> &normal) const;

    /** The same on the true surface of the body, at a point over boundary face @p face. */
    Tensor<1, 3>
    surface_traction(unsigned int face, const mesh::SurfacePoint &at) const;

    /** The body's surface; made when it is first asked for. Not collective. */
    const mesh::TrueSurface &
    surface() const;

    /** Whether a body force or weight acts anywhere. */
    bool
    has_body_force() const
    {
      return !body_forces.empty();
    }

    /** Sum of the body forces and the weight at a point of @p cell, force per volume. */
    Tensor<1, 3>
    body_force(unsigned int cell, const Point<3> &point) const;

  private:
    /** An expression, evaluated once where it is a constant. */
    struct Value
    {
      Value(const std::array<std::string, 3> &texts, const std::string &what);
      Tensor<1, 3>
      operator()(const Point<3> &point, const Tensor<1, 3> &normal = Tensor<1, 3>()) const
      {
        return is_constant ? constant : expression(point, normal);
      }
      core::SurfaceExpression expression;
      bool                    is_constant, uses_normal;
      Tensor<1, 3>            constant;
    };
    struct FaceLoad
    {
      unsigned int value; ///< index into values
      bool         is_pressure;
    };
    struct PatchConditions
    {
      unsigned char         held = 0, known = 7;
      std::vector<FaceLoad> loads;
    };
    struct BodyForce
    {
      unsigned int          value;   ///< index into values
      std::map<int, double> factors; ///< per region: 1, or the density; others: none
    };

    const mesh::TetMesh                       &mesh;
    scene::MeshParameters                      mesh_parameters; ///< for the surface
    std::vector<Value>                         values;
    std::vector<PatchConditions>               patches; ///< as TetMesh::patches
    std::vector<BodyForce>                     body_forces;
    mutable std::unique_ptr<mesh::TrueSurface> true_surface;
  };
} // namespace tetradapt::compare

#endif
