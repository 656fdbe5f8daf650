// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/reference_cache.h"

#include "tetradapt/compare/fingerprint.h"
#include "tetradapt/compare/problem_of_reference.h"
#include "tetradapt/core/atomic_file.h"
#include "tetradapt/core/on_first_rank.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

namespace tetradapt::compare
{
  namespace
  {
    /** To be raised whenever the layout below changes. */
    constexpr std::uint32_t format_version = 4;
    constexpr std::uint32_t byte_order     = 0x01020304;

    struct Header
    {
      char          magic[16];
      std::uint32_t byte_order, format;
      std::uint64_t length; ///< of what follows the header
      char          key[32];
      char          checksum[32]; ///< of what follows the header
    };
    constexpr char magic[17] = "tetradapt refer\n";

    class Writer
    {
    public:
      template <typename T>
      void
      value(const T &x)
      {
        bytes.append(reinterpret_cast<const char *>(&x), sizeof(T));
      }
      template <typename T>
      void
      array(const std::vector<T> &x)
      {
        value(std::uint64_t(x.size()));
        bytes.append(reinterpret_cast<const char *>(x.data()), x.size() * sizeof(T));
      }
      void
      text(const std::string &x)
      {
        value(std::uint64_t(x.size()));
        bytes.append(x);
      }

      std::string bytes;
    };

    /** Throws std::out_of_range when the bytes end too early. */
    class Reader
    {
    public:
      Reader(const char *begin, const std::size_t size) : next(begin), left(size)
      {
      }
      template <typename T>
      void
      value(T &x)
      {
        std::memcpy(&x, take(1, sizeof(T)), sizeof(T));
      }
      template <typename T>
      void
      array(std::vector<T> &x)
      {
        std::uint64_t n = 0;
        value(n);
        const char *from = take(n, sizeof(T));
        x.resize(n);
        if (n > 0)
          std::memcpy(static_cast<void *>(x.data()), from, n * sizeof(T));
      }
      void
      text(std::string &x)
      {
        std::uint64_t n = 0;
        value(n);
        x.assign(take(n, 1), n);
      }
      bool
      at_end() const
      {
        return left == 0;
      }

    private:
      const char *
      take(const std::uint64_t n, const std::size_t size)
      {
        if (n > left / size)
          throw std::out_of_range("The data end too early.");
        const char *from = next;
        next += n * size;
        left -= n * size;
        return from;
      }
      const char *next;
      std::size_t left;
    };

    std::string
    pack(const CachedReference &reference)
    {
      Writer      out;
      const auto &mesh = reference.mesh;
      out.array(mesh.points);
      out.array(mesh.cells);
      out.array(mesh.regions);
      out.array(mesh.faces);
      out.value(std::uint64_t(mesh.patches.size()));
      for (const auto &patch : mesh.patches)
        {
          out.value(patch.boundary_id);
          out.text(patch.name);
          out.value(std::uint64_t(patch.selections.size()));
          for (const auto &selection : patch.selections)
            out.text(selection);
        }
      out.value(std::uint64_t(mesh.region_names.size()));
      for (const auto &region : mesh.region_names)
        {
          out.value(region.first);
          out.text(region.second);
        }
      out.value(reference.degree);
      out.array(reference.values);
      out.array(reference.pressures);
      for (const auto &planes : reference.planes)
        out.array(planes);
      out.value(std::uint64_t(reference.hexahedra.size()));
      for (const auto &cell : reference.hexahedra)
        {
          out.value(cell.lower);
          out.value(cell.size);
          out.value(cell.region);
        }
      out.value(reference.energy);
      out.value(reference.estimated_error);
      out.value(reference.known_energy);
      out.value(reference.seconds);
      out.text(reference.description);
      return out.bytes;
    }

    void
    unpack(Reader in, CachedReference &reference)
    {
      auto         &mesh = reference.mesh;
      std::uint64_t n    = 0;
      in.array(mesh.points);
      in.array(mesh.cells);
      in.array(mesh.regions);
      in.array(mesh.faces);
      in.value(n);
      for (std::uint64_t i = 0; i < n; ++i)
        {
          mesh.patches.emplace_back();
          auto         &patch        = mesh.patches.back();
          std::uint64_t n_selections = 0;
          in.value(patch.boundary_id);
          in.text(patch.name);
          in.value(n_selections);
          for (std::uint64_t k = 0; k < n_selections; ++k)
            {
              patch.selections.emplace_back();
              in.text(patch.selections.back());
            }
        }
      in.value(n);
      for (std::uint64_t i = 0; i < n; ++i)
        {
          int id = 0;
          in.value(id);
          in.text(mesh.region_names[id]);
        }
      in.value(reference.degree);
      in.array(reference.values);
      in.array(reference.pressures);
      for (auto &planes : reference.planes)
        in.array(planes);
      in.value(n);
      for (std::uint64_t i = 0; i < n; ++i)
        {
          reference.hexahedra.emplace_back();
          in.value(reference.hexahedra.back().lower);
          in.value(reference.hexahedra.back().size);
          in.value(reference.hexahedra.back().region);
        }
      in.value(reference.energy);
      in.value(reference.estimated_error);
      in.value(reference.known_energy);
      in.value(reference.seconds);
      in.text(reference.description);
      if (!in.at_end())
        throw std::out_of_range("There are data after the end.");
    }

    std::string
    checksum(const char *bytes, const std::size_t size)
    {
      Fingerprint hash;
      hash.add(bytes, size);
      return hash.hex();
    }

    /** What is wrong with the header, or nothing. */
    std::string
    problem_of(const std::string &content, const std::string &key)
    {
      Header header;
      if (content.size() < sizeof(header))
        return "it is truncated";
      std::memcpy(&header, content.data(), sizeof(header));
      if (std::memcmp(header.magic, magic, sizeof(header.magic)) != 0)
        return "it is not a file of this kind, or it is damaged";
      if (header.byte_order != byte_order || header.format != format_version)
        return "it is of another version of the program or of another machine";
      if (std::string(header.key, sizeof(header.key)) != key)
        return "it holds another scene's reference, or is damaged";
      if (header.length != content.size() - sizeof(header))
        return header.length > content.size() - sizeof(header) ? "it is truncated"
                                                               : "it is longer than it says";
      if (std::string(header.checksum, sizeof(header.checksum))
          != checksum(content.data() + sizeof(header), content.size() - sizeof(header)))
        return "it is damaged: its checksum does not match";
      return "";
    }
  } // namespace

  void
  broadcast(CachedReference &reference, MPI_Comm communicator)
  {
    if (core::is_alone(communicator))
      return;
    std::string bytes;
    core::on_first_rank(communicator, [&] { bytes = pack(reference); });
    std::size_t size = bytes.size();
    core::broadcast_bytes(&size, sizeof(size), communicator);
    bytes.resize(size);
    core::broadcast_bytes(bytes.data(), size, communicator);
    reference = CachedReference();
    unpack(Reader(bytes.data(), size), reference);
  }

  void
  write_reference_cache(const std::string     &file,
                        const std::string     &key,
                        const CachedReference &reference)
  {
    const std::string content = pack(reference);
    Header            header;
    std::memcpy(header.magic, magic, sizeof(header.magic));
    header.byte_order = byte_order;
    header.format     = format_version;
    header.length     = content.size();
    key.copy(header.key, sizeof(header.key));
    checksum(content.data(), content.size()).copy(header.checksum, sizeof(header.checksum));
    core::AtomicFile out(file);
    out.stream().write(reinterpret_cast<const char *>(&header), sizeof(header));
    out.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
    out.commit(true);
  }

  CacheResult
  read_reference_cache(const std::string &file, const std::string &key)
  {
    CacheResult     result;
    std::error_code error;
    const auto      size = std::filesystem::file_size(file, error);
    if (error)
      {
        if (std::filesystem::exists(file, error))
          result.problem = "it cannot be read";
        return result;
      }
    std::string   content(size, '\0');
    std::ifstream in(file, std::ios::binary);
    if (!in.read(content.data(), static_cast<std::streamsize>(size)))
      {
        result.problem = "it cannot be read";
        return result;
      }
    result.problem = problem_of(content, key);
    if (!result.problem.empty())
      return result;
    try
      {
        auto reference = std::make_unique<CachedReference>();
        unpack(Reader(content.data() + sizeof(Header), content.size() - sizeof(Header)),
               *reference);
        result.problem = problem_of_reference(*reference);
        if (result.problem.empty())
          result.reference = std::move(reference);
      }
    catch (const std::out_of_range &)
      {
        result.problem = "its data do not fit together";
      }
    catch (const std::bad_alloc &)
      {
        result.problem = "it needs more memory than there is";
      }
    return result;
  }
} // namespace tetradapt::compare
