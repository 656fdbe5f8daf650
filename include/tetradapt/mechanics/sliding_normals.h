// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_sliding_normals_h
#define tetradapt_mechanics_sliding_normals_h

#include "tetradapt/mesh/true_surface.h"
#include "tetradapt/scene/scene.h"

#include <memory>
#include <set>

namespace tetradapt::mechanics
{
  using dealii::Point;
  using dealii::Tensor;

  /**
   * The directions along which the nodes of sliding supports are held.
   *
   * The normals of facets do not do at nodes where these approximate a curved wall: two that
   * differ a little hold the node in two directions, three in all of them, so that on finer
   * and finer meshes the wall would be clamped. This is I. Babuska's paradox of the polygons
   * that approximate a circular plate. So a node has one normal, a mean of those of
   * the faces around that meet at less than the feature angle; and where the scene projects the
   * boundary on a surface, these are that surface's at the node. Beyond that angle, as at the
   * edges of a block, a node has two or three normals, and slides along the edge or not at all.
   */
  class SlidingNormals
  {
  public:
    /** A direction in which a place is held. */
    struct Direction
    {
      Tensor<1, 3>           normal;   ///< outward, of length 1
      std::set<unsigned int> supports; ///< whose faces it is made of
      /** The largest difference from a normal that it is a mean of: how uncertain it is. */
      double spread = 0.;
    };

    /** Keeps a reference to the mesh, whose patches name the supports.
     * @param surface says what the boundary is projected on, and the feature angle. */
    SlidingNormals(const std::vector<scene::SupportParameters> &supports,
                   const mesh::TetMesh                         &mesh,
                   const scene::MeshParameters                 &surface);

    /** No support slides. */
    bool
    empty() const
    {
      return sliding_faces.empty();
    }
    /** The boundary faces that slide, ascending. */
    const std::vector<unsigned int> &
    faces() const
    {
      return sliding_faces;
    }
    /** The supports that slide on a face. */
    std::vector<unsigned int>
    supports_of(unsigned int face) const;

    /** The directions at a place, such as a vertex, which @p around have in common: sliding faces,
     * in any order. No two of them are closer than the feature angle, apart from a normal and
     * its opposite. */
    std::vector<Direction>
    at(const Point<3> &place, const std::vector<unsigned int> &around) const;

    /** The largest angle in degrees below the feature angle at which two sliding faces that
     * no surface is known for meet at an edge; 0 if there are none. */
    double
    largest_averaged_angle() const;

  private:
    Tensor<1, 3>
    normal_at(const Point<3> &place, unsigned int face) const;

    const mesh::TetMesh                   &mesh;
    std::vector<std::vector<unsigned int>> on_patch; ///< numbers of sliding supports
    std::vector<unsigned int>              sliding_faces;
    double                                 feature_cosine;
    bool                                   by_facets; ///< of the surface that is projected on
    std::unique_ptr<mesh::TrueSurface>     surface;
  };

  /** What to tell the user about sliding faces which meet at an angle that may be a true edge. */
  std::vector<std::string>
  sliding_warnings(const scene::Scene &scene, const mesh::TetMesh &mesh);
} // namespace tetradapt::mechanics

#endif
