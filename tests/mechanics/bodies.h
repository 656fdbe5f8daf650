// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_tests_mechanics_bodies_h
#define tetradapt_tests_mechanics_bodies_h

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/face_selectors.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/mesh/selection.h"
#include "tetradapt/scene/scene.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <memory>

/** Scenes put together in code, bodies to put them on, and comparisons with exact
 * values, for the tests of mechanics and solve. */
namespace bodies
{
  using namespace tetradapt;
  using dealii::Point;
  using dealii::Tensor;

  /** Says whether @p value is @p exact, to @p tolerance of @p scale. */
  inline void
  check(const std::string &what, double value, double exact, double scale, double tolerance)
  {
    const bool good = std::abs(value - exact) <= tolerance * scale; // false for NaN
    std::cout << what << ": ";
    if (good)
      std::cout << "exact\n";
    else
      std::cout << "WRONG, " << value << " instead of " << exact << '\n';
  }

  inline void
  check(const std::string &what, bool holds)
  {
    std::cout << what << ": " << (holds ? "yes" : "NO") << '\n';
  }

  /** The message of the error that @p action throws. */
  inline void
  print_refusal(const std::string &what, const std::function<void()> &action)
  {
    std::cout << what << ": ";
    try
      {
        action();
        std::cout << "ACCEPTED\n";
      }
    catch (const core::InputError &error)
      {
        std::cout << error.what() << '\n';
      }
  }

  inline scene::MaterialParameters
  material(const std::string &name, double young_modulus, double poisson_ratio)
  {
    scene::MaterialParameters m;
    m.name                       = name;
    m.constants["Young modulus"] = young_modulus;
    m.constants["Poisson ratio"] = poisson_ratio;
    return m;
  }

  using Texts = std::array<std::string, 3>;

  /** A support of the components that @p components names. */
  inline scene::SupportParameters
  support(const std::string &name,
          const std::string &where,
          const std::string &components   = "xyz",
          const Texts       &displacement = {{"0", "0", "0"}})
  {
    scene::SupportParameters s;
    s.name           = name;
    s.selector.where = where;
    for (unsigned int c = 0; c < 3; ++c)
      s.components[c] = components.find("xyz"[c]) != std::string::npos;
    s.displacement = displacement;
    return s;
  }

  inline scene::LoadParameters
  load(const std::string &name, scene::LoadType type, const std::string &where, const Texts &value)
  {
    scene::LoadParameters l;
    l.name           = name;
    l.type           = type;
    l.selector.where = where;
    l.value          = value;
    return l;
  }

  /** A box of bricks whose points are moved by up to @p amount of a brick, those
   * of the surface along it only; no two tetrahedra are alike. Region 1 where a
   * cell's centre has x > @p border, else 0. */
  inline std::shared_ptr<mesh::TetMesh>
  box(const Point<3>                    &corner,
      const std::array<unsigned int, 3> &n,
      double                             amount = 0.2,
      double                             border = 1e30)
  {
    auto body = std::make_shared<mesh::TetMesh>(mesh::bricks(Point<3>(), corner, n));
    for (unsigned int c = 0; c < body->n_cells(); ++c)
      {
        double x = 0.;
        for (const unsigned int p : body->cells[c])
          x += 0.25 * body->points[p][0];
        body->regions[c] = x > border ? 1 : 0;
      }
    std::uint64_t state = 12345;
    for (auto &p : body->points)
      for (unsigned int d = 0; d < 3; ++d)
        {
          state              = state * 6364136223846793005ULL + 1442695040888963407ULL;
          const double shift = 2. * (state >> 11) / 9007199254740992. - 1.;
          // Points between the two regions stay there.
          const bool between = d == 0 && std::abs(p[0] - border) < 1e-9;
          if (p[d] > 0. && p[d] < corner[d] && !between)
            p[d] += amount * shift * corner[d] / n[d];
        }
    mesh::finalize(*body, "box");
    return body;
  }

  /** Puts the names of the scene's supports and loads on the patches. */
  inline void
  select(mesh::TetMesh &body, const scene::Scene &scene)
  {
    mesh::select_faces(body, mesh::face_selectors(scene));
  }
} // namespace bodies

#endif
