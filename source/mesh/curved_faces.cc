// SPDX-License-Identifier: AGPL-3.0-or-later
#include "curved_faces.h"

#include <map>

namespace tetradapt::mesh
{
  namespace
  {
    /** Cosine of the largest angle between a face's normal and the surface's. */
    constexpr double aligned = 0.5;

    Point<3>
    middle(const Point<3> &a, const Point<3> &b)
    {
      return a + 0.5 * (b - a);
    }

    /** Makes the shapes of faces one after the other; feet on smooth surfaces that faces
     * share are looked for once. */
    class Shapes
    {
    public:
      explicit Shapes(const TetMesh &mesh) : mesh(mesh)
      {
      }

      CurvedFace
      flat(const BoundaryFace &face) const
      {
        const Tensor<1, 3> area = face_area_vector(mesh, face);
        CurvedFace         result;
        result.normals.fill(area / area.norm());
        for (unsigned int i = 0; i < 3; ++i)
          {
            const Point<3> &here = mesh.points[face.vertices[i]];
            result.points[i]     = here;
            result.points[3 + i] = middle(here, mesh.points[face.vertices[(i + 1) % 3]]);
          }
        return result;
      }

      /** On a smooth surface. */
      CurvedFace
      smooth(const BoundaryFace &face, const CurvedSurface &surface)
      {
        CurvedFace   result = flat(face);
        const double length = longest_edge(result);
        for (unsigned int i = 0; i < 6; ++i)
          {
            const unsigned int a = face.vertices[i % 3], b = i < 3 ? a : face.vertices[(i + 1) % 3];
            const Key          key{&surface, std::min(a, b), std::max(a, b)};
            auto               found = feet.find(key);
            if (found == feet.end())
              found = feet.emplace(key, surface.foot(result.points[i], length)).first;
            adopt(found->second, i, result);
          }
        return result;
      }

      /** On a surface of triangles. */
      CurvedFace
      stepped(const BoundaryFace &face, const CurvedSurface &surface) const
      {
        const CurvedFace start  = flat(face);
        const double     length = longest_edge(start);
        CurvedFace       inside = start, result;
        Tensor<1, 3>     points, normals; // sums
        for (unsigned int i = 0; i < 3; ++i)
          {
            inside.points[i] = Point<3>();
            for (unsigned int j = 0; j < 3; ++j)
              inside.points[i] += (i == j ? 2. / 3. : 1. / 6.) * Tensor<1, 3>(start.points[j]);
            adopt(surface.foot(inside.points[i], length), i, inside);
            points += Tensor<1, 3>(inside.points[i]);
            normals += inside.normals[i];
          }
        for (unsigned int i = 0; i < 3; ++i)
          {
            result.points[i]  = Point<3>(2. * Tensor<1, 3>(inside.points[i]) - points / 3.);
            result.normals[i] = 2. * inside.normals[i] - normals / 3.;
          }
        for (unsigned int i = 0; i < 3; ++i)
          {
            result.points[3 + i]  = middle(result.points[i], result.points[(i + 1) % 3]);
            result.normals[3 + i] = 0.5 * (result.normals[i] + result.normals[(i + 1) % 3]);
          }
        return result;
      }

    private:
      using Key = std::tuple<const CurvedSurface *, unsigned int, unsigned int>;

      static double
      longest_edge(const CurvedFace &flat)
      {
        double longest = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          longest = std::max(longest, flat.points[i].distance(flat.points[(i + 1) % 3]));
        return longest;
      }

      /** Replaces node @p i of a face whose normal is still there by the foot, unless
       * that belongs to another part of the surface. */
      static void
      adopt(const std::optional<SurfacePoint> &foot, const unsigned int i, CurvedFace &face)
      {
        if (!foot)
          return;
        const double cosine = foot->normal * face.normals[i];
        if (std::abs(cosine) < aligned)
          return;
        face.points[i]  = foot->point;
        face.normals[i] = cosine > 0. ? foot->normal : -foot->normal;
      }

      const TetMesh                             &mesh;
      std::map<Key, std::optional<SurfacePoint>> feet;
    };
  } // namespace

  std::vector<CurvedFace>
  curved_faces(const TetMesh &mesh, const std::vector<const CurvedSurface *> &surface_of)
  {
    Shapes                  shapes(mesh);
    std::vector<CurvedFace> result;
    result.reserve(mesh.faces.size());
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      if (surface_of[f] == nullptr)
        result.push_back(shapes.flat(mesh.faces[f]));
      else if (surface_of[f]->has_steps())
        result.push_back(shapes.stepped(mesh.faces[f], *surface_of[f]));
      else
        result.push_back(shapes.smooth(mesh.faces[f], *surface_of[f]));
    return result;
  }
} // namespace tetradapt::mesh
