// SPDX-License-Identifier: AGPL-3.0-or-later

// The cache of references: what is read is what was written; damage anywhere is
// noticed; the key depends on what determines a reference and on nothing else.

#include "tetradapt/compare/reference_cache.h"
#include "tetradapt/compare/fingerprint.h"
#include "tetradapt/compare/reference_key.h"

#include "test_meshes.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <random>
#include <set>

using namespace test_meshes;
using namespace tetradapt::compare;

namespace
{
  const std::string file = "reference_cache_test.bin";
  const std::string key(32, 'a');

  template <typename T>
  bool
  same(const std::vector<T> &a, const std::vector<T> &b)
  {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
  }

  std::string
  content()
  {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  std::string
  problem_with(const std::string &bytes)
  {
    std::ofstream(file, std::ios::binary) << bytes;
    const CacheResult result = read_reference_cache(file, key);
    return result.reference ? "none noticed" : result.problem;
  }

  CachedReference
  example()
  {
    CachedReference reference;
    reference.mesh              = *cube(2, shaken(2, 0.2, 1));
    reference.mesh.patches      = {{3, "left wall", {"Supports/a", "Loads/b"}}, {7, "", {}}};
    reference.mesh.faces        = {{{{0, 1, 4}}, 0}, {{{1, 2, 5}}, 1}};
    reference.mesh.region_names = {{0, "bone"}, {1, ""}};
    reference.degree            = 2;
    Random random(3);
    for (unsigned int i = 0; i < 125; ++i)
      reference.values.push_back(Tensor<1, 3>({random(), random(), random()}));
    reference.energy          = 4.004140;
    reference.estimated_error = 1e-3;
    reference.seconds         = 12.5;
    reference.description     = "P2, on a cube";
    return reference;
  }

  void
  check_round_trip(const CachedReference &a)
  {
    write_reference_cache(file, key, a);
    const CacheResult result = read_reference_cache(file, key);
    if (!result.reference)
      {
        std::cout << "NOT READ: " << result.problem << std::endl;
        return;
      }
    const CachedReference &b       = *result.reference;
    bool                   patches = b.mesh.patches.size() == 2 && same(a.mesh.faces, b.mesh.faces);
    for (unsigned int i = 0; patches && i < 2; ++i)
      patches = a.mesh.patches[i].boundary_id == b.mesh.patches[i].boundary_id
                && a.mesh.patches[i].name == b.mesh.patches[i].name
                && a.mesh.patches[i].selections == b.mesh.patches[i].selections;
    std::cout << "round trip: mesh "
              << (same(a.mesh.points, b.mesh.points) && same(a.mesh.cells, b.mesh.cells)
                  && a.mesh.regions == b.mesh.regions && a.mesh.region_names == b.mesh.region_names)
              << ", boundary " << patches << ", displacement "
              << (a.degree == b.degree && same(a.values, b.values)) << ", figures "
              << (a.energy == b.energy && a.estimated_error == b.estimated_error
                  && a.seconds == b.seconds && a.description == b.description)
              << std::endl;
  }

  void
  check_damage()
  {
    const std::string good      = content();
    unsigned int      unnoticed = 0;
    for (std::size_t i = 0; i < good.size(); i += i < 200 ? 1 : 97)
      for (const char flip : {1, -128})
        {
          std::string bad = good;
          bad[i]          = static_cast<char>(bad[i] ^ flip);
          unnoticed += problem_with(bad) == "none noticed";
        }
    std::cout << "single bits flipped, unnoticed: " << unnoticed << std::endl;
    unnoticed = 0;
    for (std::size_t n = 0; n < good.size(); n += n < 200 ? 1 : 97)
      unnoticed += problem_with(good.substr(0, n)) == "none noticed";
    std::cout << "truncated, unnoticed: " << unnoticed << std::endl;
    std::string swapped = good;
    std::swap_ranges(swapped.begin() + 200, swapped.begin() + 208, swapped.begin() + 240);
    std::cout << "empty: " << problem_with("") << std::endl
              << "text: " << problem_with(std::string(500, 'x')) << std::endl
              << "truncated by one byte: " << problem_with(good.substr(0, good.size() - 1))
              << std::endl
              << "one byte more: " << problem_with(good + '\0') << std::endl
              << "two numbers exchanged: " << problem_with(swapped) << std::endl
              << "unchanged: " << problem_with(good) << std::endl;
    const CacheResult other = read_reference_cache(file, std::string(32, 'b'));
    std::cout << "other key: " << other.problem << std::endl;
    std::filesystem::remove(file);
    const CacheResult missing = read_reference_cache(file, key);
    std::cout << "no file: " << (missing.reference || !missing.problem.empty() ? "WRONG" : "none")
              << std::endl;
    std::filesystem::create_directory(file);
    std::cout << "a folder of this name: " << read_reference_cache(file, key).problem << std::endl;
    std::filesystem::remove(file);
  }

  /** @p bytes with a checksum and a length that fit. */
  std::string
  sealed(std::string bytes)
  {
    constexpr std::size_t length_at = 24, sum_at = 64, start = 96;
    const std::uint64_t   length = bytes.size() - start;
    bytes.replace(length_at, 8, reinterpret_cast<const char *>(&length), 8);
    Fingerprint hash;
    hash.add(bytes.data() + start, length);
    return bytes.replace(sum_at, 32, hash.hex());
  }

  /** Whether all that others will take for granted is so. */
  bool
  is_sound(const CachedReference &reference)
  {
    const auto &mesh = reference.mesh;
    bool        good = mesh.regions.size() == mesh.n_cells()
                && std::isfinite(reference.energy + reference.estimated_error);
    for (const auto &cell : mesh.cells)
      for (const unsigned int v : cell)
        good = good && v < mesh.n_points();
    for (const auto &face : mesh.faces)
      for (const unsigned int v : face.vertices)
        good = good && v < mesh.n_points() && face.patch < mesh.patches.size();
    for (const auto &value : reference.values)
      good = good && std::isfinite(value[0]) && std::isfinite(value[1]) && std::isfinite(value[2]);
    if (!good || !reference.hexahedra.empty())
      return good; // its constructor checks the rest
    const mesh::NodalField field(std::make_shared<mesh::TetMesh>(mesh), reference.degree);
    return field.values.size() == reference.values.size()
           && (reference.pressures.empty() || reference.pressures.size() == mesh.n_points());
  }

  /** A file that is whole by its checksum and wrong nevertheless. */
  void
  fuzz(const std::string &what, const CachedReference &example, const unsigned int n)
  {
    write_reference_cache(file, key, example);
    const std::string good    = content();
    constexpr int     start   = 96;
    unsigned int      n_taken = 0, n_unsound = 0;
    std::mt19937      generator(7);
    const auto        below = [&](const std::size_t m) { return generator() % m; };
    for (unsigned int i = 0; i < n; ++i)
      {
        std::string bad = good;
        for (unsigned int k = 0; k <= i % 3; ++k)
          {
            const std::size_t at = start + below(bad.size() - start - 8);
            if (i % 4 == 0)
              bad.erase(at, 1 + below(40));
            else if (i % 4 == 1)
              bad.insert(at, 1 + below(9), static_cast<char>(below(256)));
            else if (i % 4 == 2)
              bad[at] = static_cast<char>(below(256));
            else
              {
                // A count or an index that is far too large, or a number that is none.
                const std::size_t   word     = start + (at - start) / 8 * 8;
                const std::uint64_t values[] = {~0ULL, 1ULL << 40, 1ULL << 31, 0x7ff8ULL << 48, 0};
                bad.replace(word, 8, reinterpret_cast<const char *>(&values[below(5)]), 8);
              }
          }
        bad = sealed(bad);
        std::filesystem::remove(file); // writing over a file waits for the disk
        std::ofstream(file, std::ios::binary) << bad;
        const CacheResult result = read_reference_cache(file, key);
        n_taken += result.reference != nullptr;
        n_unsound += result.reference != nullptr && !is_sound(*result.reference);
      }
    std::ofstream(file, std::ios::binary) << sealed(good);
    std::cout << what << ": unchanged is read "
              << (read_reference_cache(file, key).reference != nullptr)
              << ", some changes are seen " << (n_taken < n) << ", unsound " << n_unsound
              << std::endl;
    std::filesystem::remove(file);
  }

  CachedReference
  hexahedral_example()
  {
    CachedReference reference;
    reference.degree = 2;
    reference.planes = {{{0., 1., 3.}, {-1., 1.}, {0., 2.}}};
    reference.hexahedra.resize(2);
    reference.hexahedra[0].lower = Point<3>(0., -1., 0.);
    reference.hexahedra[0].size  = Tensor<1, 3>({1., 2., 2.});
    reference.hexahedra[1].lower = Point<3>(1., -1., 0.);
    reference.hexahedra[1].size  = Tensor<1, 3>({2., 2., 2.});
    reference.values.resize(54);
    reference.energy = 1.;
    return reference;
  }

  void
  check_indices()
  {
    const auto problem = [](const auto &change) {
      CachedReference reference = example();
      change(reference);
      write_reference_cache(file, key, reference);
      const CacheResult result = read_reference_cache(file, key);
      std::cout << "  " << (result.reference ? "none noticed" : result.problem) << std::endl;
      std::filesystem::remove(file);
    };
    std::cout << "whole, but wrong:" << std::endl;
    problem([](CachedReference &r) { r.mesh.cells[3][2] = r.mesh.n_points(); });
    problem([](CachedReference &r) { std::swap(r.mesh.cells[5][0], r.mesh.cells[5][1]); });
    problem([](CachedReference &r) { r.mesh.regions.pop_back(); });
    problem([](CachedReference &r) { r.mesh.faces[1].vertices[0] = 4000; });
    problem([](CachedReference &r) { r.mesh.faces[1].patch = 2; });
    problem([](CachedReference &r) { r.mesh.points[7][1] = std::nan(""); });
    problem([](CachedReference &r) { r.degree = 3; });
    problem([](CachedReference &r) { r.degree = 1; });
    problem([](CachedReference &r) { r.values.pop_back(); });
    problem([](CachedReference &r) { r.values[9][0] = HUGE_VAL; });
    problem([](CachedReference &r) { r.pressures.resize(26); });
    problem([](CachedReference &r) { r.energy = std::nan(""); });
    problem([](CachedReference &r) { r.hexahedra.resize(1); });
    problem([](CachedReference &r) { r = hexahedral_example(); });
    problem([](CachedReference &r) {
      r = hexahedral_example();
      std::swap(r.planes[0][1], r.planes[0][2]);
    });
    problem([](CachedReference &r) {
      r                       = hexahedral_example();
      r.hexahedra[1].lower[2] = 1.;
    });
    problem([](CachedReference &r) {
      r              = hexahedral_example();
      r.hexahedra[1] = r.hexahedra[0];
    });
    fuzz("tetrahedra", example(), 4000);
    fuzz("hexahedra", hexahedral_example(), 2000);
  }

  void
  check_keys()
  {
    const auto   mesh = cube(1, [](const Point<3> &p) { return p; });
    scene::Scene scene;
    scene.materials.resize(1);
    scene.supports.resize(1);
    scene.loads.resize(1);
    scene.reference.type         = scene::ReferenceParameters::Type::fine_mesh;
    scene.reference.volume_bound = 0.01;
    const std::string original   = reference_key(scene, *mesh);

    std::set<std::string> keys{original};
    unsigned int          changes = 0;
    const auto            changed = [&](const std::function<void(scene::Scene &)> &change) {
      scene::Scene copy = scene;
      change(copy);
      keys.insert(reference_key(copy, *mesh));
      ++changes;
    };
    changed([](scene::Scene &s) { s.materials[0].constants["Young modulus"] *= 1. + 1e-15; });
    changed([](scene::Scene &s) { s.materials[0].constants["Poisson ratio"] = 0.31; });
    changed([](scene::Scene &s) { s.materials[0].regions = {0}; });
    changed([](scene::Scene &s) { s.materials.resize(2); });
    changed([](scene::Scene &s) { s.supports[0].components[1] = false; });
    changed([](scene::Scene &s) { s.supports[0].selector.where = "x<1e-9"; });
    changed([](scene::Scene &s) { s.supports[0].displacement[2] = "0.1"; });
    changed([](scene::Scene &s) { s.loads[0].value[2] = "-1"; });
    changed([](scene::Scene &s) { s.loads[0].type = scene::LoadType::pressure; });
    changed([](scene::Scene &s) { s.loads[0].selector.groups = {"ab", "c"}; });
    changed([](scene::Scene &s) { s.loads[0].selector.groups = {"a", "bc"}; });
    changed([](scene::Scene &s) { s.reference.degree = 1; });
    changed([](scene::Scene &s) { s.reference.volume_bound = 0.02; });
    changed([](scene::Scene &s) { s.reference.size = "0.1"; });
    changed([](scene::Scene &s) { s.reference.dihedral_angle = 12.; });
    changed([](scene::Scene &s) { s.tetgen.optimisation_level = 1; });
    changed([](scene::Scene &s) { s.solver.tolerance = 1e-9; });
    changed(
      [](scene::Scene &s) { s.reference.route = scene::ReferenceParameters::MeshRoute::bricks; });
    auto moved = *mesh;
    moved.points[3][1] += 1e-15;
    keys.insert(reference_key(scene, moved));
    moved                       = *mesh;
    moved.patches               = {{1, "", {"Loads/a"}}};
    const std::string one_patch = reference_key(scene, moved);
    keys.insert(one_patch);
    std::cout << "changes that matter: " << changes + 2 << ", different keys: " << keys.size() - 1
              << std::endl;

    scene::Scene same                 = scene;
    same.adaptivity.max_cycles        = 9;
    same.output.vtu                   = false;
    same.degree                       = 2;
    same.title                        = "other";
    same.tetgen.time_limit            = 1.;
    same.exact_solution.strain_energy = 1.;
    std::cout << "changes that do not matter: "
              << (reference_key(same, *mesh) == original ? "same key" : "OTHER KEY") << std::endl;

    scene.reference.route = scene::ReferenceParameters::MeshRoute::file;
    scene.reference.file  = "reference_cache_test.msh";
    std::ofstream(scene.reference.file) << "one";
    const std::string one = reference_key(scene, *mesh);
    std::ofstream(scene.reference.file) << "two";
    const std::string two = reference_key(scene, *mesh);
    std::filesystem::remove(scene.reference.file);
    std::cout << "file's content: " << (one != two ? "other key" : "SAME KEY") << std::endl;
  }

  void
  check_fingerprint()
  {
    // Every single bit and every length up to 200 bytes gives another hash.
    std::set<std::string> hashes;
    unsigned int          n = 0;
    const std::string     zeros(200, '\0');
    for (unsigned int length = 0; length <= 200; ++length, ++n)
      {
        Fingerprint hash;
        hash.add(zeros.substr(0, length));
        hashes.insert(hash.hex());
      }
    for (unsigned int bit = 0; bit < 8 * 200; ++bit, ++n)
      {
        std::string text = zeros;
        text[bit / 8]    = static_cast<char>(1 << (bit % 8));
        Fingerprint hash;
        hash.add(text);
        hashes.insert(hash.hex());
      }
    std::cout << "hashed: " << n << ", different: " << hashes.size() << std::endl;
  }
} // namespace

int
main()
{
  check_round_trip(example());
  check_damage();
  check_indices();
  check_keys();
  check_fingerprint();
}
