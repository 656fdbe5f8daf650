// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_descriptor_buffer_h
#define tetradapt_core_descriptor_buffer_h

#include <streambuf>
#include <string>
#include <vector>

namespace tetradapt::core
{
  /**
   * The buffer of an output stream that writes to a file descriptor, which it owns: a file
   * that was opened once is never opened by its name again, and the reason of the first
   * write that failed is kept, which std::filebuf does not.
   */
  class DescriptorBuffer : public std::streambuf
  {
  public:
    DescriptorBuffer();
    ~DescriptorBuffer() override;
    DescriptorBuffer(const DescriptorBuffer &) = delete;
    DescriptorBuffer &
    operator=(const DescriptorBuffer &)
      = delete;

    /**
     * Creates the file @p path, which must not exist, not even as a symbolic link, and
     * writes to it. The user's umask decides on the permissions.
     * @return 0, or the system's error number.
     */
    int
    create(const std::string &path);

    /** Writes what is buffered and waits until the disk has it. Returns 0, or the error
     * number of the first failure. */
    int
    sync_to_disk();

    /** Writes what is buffered and closes. Returns as sync_to_disk(). */
    int
    close();

    /** Error number of the first failure, 0 if there was none. */
    int
    error() const
    {
      return first_error;
    }

  protected:
    int_type
    overflow(int_type c) override;
    std::streamsize
    xsputn(const char *text, std::streamsize n) override;
    int
    sync() override;

  private:
    bool
    write_all(const char *data, std::size_t n);
    bool
    write_buffered();

    std::vector<char> buffer;
    int               descriptor  = -1;
    int               first_error = 0;
  };
} // namespace tetradapt::core

#endif
