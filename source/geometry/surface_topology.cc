// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/geometry/surface_topology.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace tetradapt::geometry
{
  namespace
  {
    using core::InputError;

    /** A triangle is degenerate if its height is below this part of its longest
     * edge: TetGen takes points for collinear at 1e-8. */
    constexpr double smallest_height = 1e-9;

    /** Squares and cubes of larger coordinates leave the range of double. */
    constexpr double largest_coordinate = 1e100;

    /** One of the three edges of a triangle. */
    struct Edge
    {
      unsigned int first, second; ///< point numbers, smaller first
      unsigned int triangle;
      bool         forward; ///< whether the triangle runs from first to second

      bool
      same(const Edge &other) const
      {
        return first == other.first && second == other.second;
      }
      bool
      operator<(const Edge &other) const
      {
        return first != other.first     ? first < other.first
               : second != other.second ? second < other.second
                                        : triangle < other.triangle;
      }
    };

    std::string
    describe(const SurfaceMesh &surface, unsigned int triangle)
    {
      std::string text = "triangle " + std::to_string(triangle) + " with corners ";
      for (unsigned int i = 0; i < 3; ++i)
        text += (i > 0 ? ", " : "") + to_string(surface.points[surface.triangles[triangle][i]]);
      return text;
    }

    std::string
    describe(const SurfaceMesh &surface, const Edge &edge)
    {
      return "from " + to_string(surface.points[edge.first]) + " to "
             + to_string(surface.points[edge.second]) + " (triangle "
             + std::to_string(edge.triangle) + ')';
    }

    /** "1 thing" or "5 things". */
    std::string
    count(std::size_t n, const std::string &thing)
    {
      return std::to_string(n) + ' ' + thing + (n == 1 ? "" : "s");
    }

    void
    check_numbers(const SurfaceMesh &surface, const std::string &what)
    {
      if (surface.points.empty() || surface.triangles.empty())
        throw InputError(what + ": there are no triangles.");
      if (surface.points.size() > std::numeric_limits<int>::max() / 4
          || surface.triangles.size() > std::numeric_limits<int>::max() / 4)
        throw InputError(what + ": there are too many triangles for this program.");
      if (!surface.ids.empty() && surface.ids.size() != surface.triangles.size())
        throw InputError(what + ": there is not one boundary id a triangle.");
      for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        for (const unsigned int v : surface.triangles[i])
          if (v >= surface.points.size())
            throw InputError(what + ": triangle " + std::to_string(i) + " names point "
                             + std::to_string(v) + ", but there are only "
                             + count(surface.points.size(), "point") + " (counted from 0).");
      for (std::size_t i = 0; i < surface.points.size(); ++i)
        for (unsigned int d = 0; d < 3; ++d)
          if (!(std::abs(surface.points[i][d]) <= largest_coordinate))
            throw InputError(what + ": point " + std::to_string(i) + " is at "
                             + to_string(surface.points[i])
                             + "; coordinates must be finite and below 1e100.");
    }

    unsigned int
    remove_unused_points(SurfaceMesh &surface)
    {
      std::vector<unsigned int> number(surface.points.size(), 0);
      for (const auto &triangle : surface.triangles)
        for (const unsigned int v : triangle)
          number[v] = 1;
      unsigned int n_used = 0;
      for (std::size_t i = 0; i < number.size(); ++i)
        if (number[i] != 0)
          {
            surface.points[n_used] = surface.points[i];
            number[i]              = n_used++;
          }
      const unsigned int n_removed = surface.points.size() - n_used;
      surface.points.resize(n_used);
      if (n_removed > 0)
        for (auto &triangle : surface.triangles)
          for (unsigned int &v : triangle)
            v = number[v];
      return n_removed;
    }

    void
    check_degenerate(const SurfaceMesh &surface, const std::string &what)
    {
      std::size_t n = 0, first = 0;
      for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        {
          const auto                &t = surface.triangles[i];
          const auto                &p = surface.points;
          const dealii::Tensor<1, 3> a = p[t[1]] - p[t[0]], b = p[t[2]] - p[t[0]], c = b - a;
          const double longest = std::max({a.norm_square(), b.norm_square(), c.norm_square()});
          if (dealii::cross_product_3d(a, b).norm() <= smallest_height * longest && n++ == 0)
            first = i;
        }
      if (n > 0)
        throw InputError(what + ": " + count(n, "triangle") + (n == 1 ? " has" : " have")
                         + " no area; the first is " + describe(surface, first)
                         + ". Remove degenerate triangles.");
    }

    void
    check_repeated_points(const SurfaceMesh &surface, const std::string &what)
    {
      const auto               &p = surface.points;
      std::vector<unsigned int> order(p.size());
      std::iota(order.begin(), order.end(), 0U);
      const auto key
        = [&](unsigned int i) { return std::make_tuple(p[i][0], p[i][1], p[i][2], i); };
      std::sort(order.begin(), order.end(), [&](unsigned int i, unsigned int j) {
        return key(i) < key(j);
      });
      std::size_t  n     = 0;
      unsigned int first = 0, second = 0;
      for (std::size_t i = 1; i < order.size(); ++i)
        if (p[order[i - 1]] == p[order[i]] && n++ == 0)
          {
            first  = order[i - 1];
            second = order[i];
          }
      if (n > 0)
        throw InputError(what + ": " + count(n, "point") + (n == 1 ? " is" : " are")
                         + " listed twice; the first pair is points " + std::to_string(first)
                         + " and " + std::to_string(second) + " at " + to_string(p[first])
                         + ". Merge duplicate vertices, so that the triangles are connected.");
    }

    void
    check_repeated_triangles(const SurfaceMesh &surface, const std::string &what)
    {
      std::vector<std::pair<std::array<unsigned int, 3>, unsigned int>> sorted;
      for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        {
          sorted.emplace_back(surface.triangles[i], i);
          std::sort(sorted.back().first.begin(), sorted.back().first.end());
        }
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i - 1].first == sorted[i].first)
          throw InputError(what + ": triangles " + std::to_string(sorted[i - 1].second) + " and "
                           + std::to_string(sorted[i].second) + " have the same corners: "
                           + describe(surface, sorted[i].second) + ". Remove duplicate triangles.");
    }

    std::vector<Edge>
    sorted_edges(const SurfaceMesh &surface)
    {
      std::vector<Edge> edges;
      edges.reserve(3 * surface.triangles.size());
      for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        for (unsigned int k = 0; k < 3; ++k)
          {
            const unsigned int a = surface.triangles[i][k], b = surface.triangles[i][(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), static_cast<unsigned int>(i), a < b});
          }
      std::sort(edges.begin(), edges.end());
      return edges;
    }

    void
    check_edges(const SurfaceMesh &surface, const std::vector<Edge> &edges, const std::string &what)
    {
      std::size_t n_open = 0, n_many = 0, first_open = 0, first_many = 0;
      for (std::size_t i = 0, next; i < edges.size(); i = next)
        {
          next = i + 1;
          while (next < edges.size() && edges[next].same(edges[i]))
            ++next;
          if (next == i + 1 && n_open++ == 0)
            first_open = i;
          if (next > i + 2 && n_many++ == 0)
            first_many = i;
        }
      if (n_many > 0)
        throw InputError(
          what + ": " + count(n_many, "edge") + (n_many == 1 ? " belongs" : " belong")
          + " to more than two triangles; the first runs " + describe(surface, edges[first_many])
          + ". Remove inner walls and separate parts that touch.");
      if (n_open > 0)
        throw InputError(what + ": the surface is not closed: " + count(n_open, "edge")
                         + (n_open == 1 ? " belongs" : " belong")
                         + " to one triangle only; the first runs "
                         + describe(surface, edges[first_open]) + ". Fill the holes.");
    }

    /** For each triangle its neighbours, and whether they run the same way. */
    struct Neighbors
    {
      std::vector<std::array<unsigned int, 3>> triangles;
      std::vector<std::array<bool, 3>>         agree;
    };

    Neighbors
    find_neighbors(std::size_t n_triangles, const std::vector<Edge> &edges)
    {
      Neighbors                  result;
      std::vector<unsigned char> n(n_triangles, 0);
      result.triangles.resize(n_triangles);
      result.agree.resize(n_triangles);
      for (std::size_t i = 0; i + 1 < edges.size(); i += 2)
        for (unsigned int side = 0; side < 2; ++side)
          {
            const unsigned int t      = edges[i + side].triangle;
            result.triangles[t][n[t]] = edges[i + 1 - side].triangle;
            result.agree[t][n[t]++]   = edges[i].forward != edges[i + 1].forward;
          }
      return result;
    }

    /** The triangles around each point must form one closed fan. */
    void
    check_fans(const SurfaceMesh &surface, const std::vector<Edge> &edges, const std::string &what)
    {
      // Corners of triangles are joined across edges; as many sets as points must
      // remain. A corner is numbered 3 * triangle + position.
      std::vector<unsigned int> parent(3 * surface.triangles.size());
      std::iota(parent.begin(), parent.end(), 0U);
      const auto root = [&](unsigned int i) {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      };
      const auto corner = [&](unsigned int triangle, unsigned int point) {
        const auto &t = surface.triangles[triangle];
        return 3 * triangle + (t[0] == point ? 0 : t[1] == point ? 1 : 2);
      };
      for (std::size_t i = 0; i + 1 < edges.size(); i += 2)
        for (const unsigned int v : {edges[i].first, edges[i].second})
          parent[root(corner(edges[i].triangle, v))] = root(corner(edges[i + 1].triangle, v));

      std::vector<unsigned int> fan(surface.points.size(),
                                    std::numeric_limits<unsigned int>::max());
      for (unsigned int t = 0; t < surface.triangles.size(); ++t)
        for (unsigned int k = 0; k < 3; ++k)
          {
            const unsigned int v = surface.triangles[t][k], r = root(3 * t + k);
            if (fan[v] == std::numeric_limits<unsigned int>::max())
              fan[v] = r;
            else if (fan[v] != r)
              throw InputError(what + ": at point " + std::to_string(v) + ' '
                               + to_string(surface.points[v])
                               + " parts of the surface touch in this point only. Separate or join "
                                 "them.");
          }
    }
  } // namespace

  std::string
  to_string(const Point<3> &point)
  {
    std::ostringstream stream;
    stream.precision(9);
    stream << '(' << point[0] << ", " << point[1] << ", " << point[2] << ')';
    return stream.str();
  }

  unsigned int
  check_triangles(SurfaceMesh &surface, const std::string &what)
  {
    check_numbers(surface, what);
    const unsigned int n_removed = remove_unused_points(surface);
    check_degenerate(surface, what);
    check_repeated_points(surface, what);
    check_repeated_triangles(surface, what);
    return n_removed;
  }

  SurfaceTopology
  orient_consistently(SurfaceMesh &surface, const std::string &what)
  {
    const auto edges = sorted_edges(surface);
    check_edges(surface, edges, what);
    check_fans(surface, edges, what);

    constexpr unsigned int unseen = std::numeric_limits<unsigned int>::max();
    const std::size_t      n      = surface.triangles.size();
    const auto             around = find_neighbors(n, edges);
    SurfaceTopology        result;
    result.component.assign(n, unseen);
    result.turned.assign(n, false);
    std::vector<unsigned int> stack;
    for (unsigned int seed = 0; seed < n; ++seed)
      {
        if (result.component[seed] != unseen)
          continue;
        result.component[seed] = result.n_components;
        stack.push_back(seed);
        while (!stack.empty())
          {
            const unsigned int t = stack.back();
            stack.pop_back();
            for (unsigned int k = 0; k < 3; ++k)
              {
                const unsigned int other = around.triangles[t][k];
                const bool         turn  = result.turned[t] != !around.agree[t][k];
                if (result.component[other] == unseen)
                  {
                    result.component[other] = result.n_components;
                    result.turned[other]    = turn;
                    stack.push_back(other);
                  }
                else if (result.turned[other] != turn)
                  throw InputError(what
                                   + ": the surface has no inside: no orientation of its "
                                     "triangles is consistent at "
                                   + describe(surface, other) + '.');
              }
          }
        ++result.n_components;
      }
    for (unsigned int t = 0; t < n; ++t)
      if (result.turned[t])
        std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    return result;
  }
} // namespace tetradapt::geometry
