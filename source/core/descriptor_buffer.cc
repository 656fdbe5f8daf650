// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/descriptor_buffer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tetradapt::core
{
  DescriptorBuffer::DescriptorBuffer() : buffer(1 << 16)
  {
    setp(buffer.data(), buffer.data() + buffer.size());
  }

  DescriptorBuffer::~DescriptorBuffer()
  {
    close();
  }

  int
  DescriptorBuffer::create(const std::string &path)
  {
    close();
    first_error = 0;
    descriptor  = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    return descriptor < 0 ? errno : 0;
  }

  bool
  DescriptorBuffer::write_all(const char *data, std::size_t n)
  {
    while (n > 0 && first_error == 0)
      {
        const ssize_t written = ::write(descriptor, data, n);
        if (written > 0)
          {
            data += written;
            n -= written;
          }
        else if (written == 0)
          first_error = EIO;
        else if (errno != EINTR)
          first_error = errno;
      }
    return first_error == 0;
  }

  bool
  DescriptorBuffer::write_buffered()
  {
    const std::size_t n = pptr() - pbase();
    setp(buffer.data(), buffer.data() + buffer.size());
    return write_all(buffer.data(), n);
  }

  DescriptorBuffer::int_type
  DescriptorBuffer::overflow(const int_type c)
  {
    if (!write_buffered())
      return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof()))
      sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

  std::streamsize
  DescriptorBuffer::xsputn(const char *text, const std::streamsize n)
  {
    if (n > epptr() - pptr())
      {
        if (!write_buffered())
          return 0;
        if (n >= static_cast<std::streamsize>(buffer.size()))
          return write_all(text, n) ? n : 0;
      }
    std::memcpy(pptr(), text, n);
    pbump(static_cast<int>(n));
    return n;
  }

  int
  DescriptorBuffer::sync()
  {
    return write_buffered() ? 0 : -1;
  }

  int
  DescriptorBuffer::sync_to_disk()
  {
    if (write_buffered() && ::fsync(descriptor) != 0)
      first_error = errno;
    return first_error;
  }

  int
  DescriptorBuffer::close()
  {
    if (descriptor < 0)
      return first_error;
    write_buffered();
    if (::close(descriptor) != 0 && first_error == 0 && errno != EINTR)
      first_error = errno;
    descriptor = -1;
    return first_error;
  }
} // namespace tetradapt::core
