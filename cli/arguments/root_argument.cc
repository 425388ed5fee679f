// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/arguments/root_argument.h"

#include <filesystem>

#include "objects/s3_address.h"
#include "security/identity.h"

namespace orbweave {

void AddRootArgument(CLI::App& command,
                     std::map<std::string, std::string>& roots,
                     const std::string& help) {
  command
      .add_option_function<std::vector<std::string>>(
          "--root",
          [&roots](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              const size_t equals = text.find('=');
              const std::string name = text.substr(0, equals);
              if (equals == std::string::npos || !CheckName(name).ok())
                throw CLI::ValidationError("--root", "'" + text + "' is not NAME=FOLDER");
              const std::string place = text.substr(equals + 1);
              roots[name] = IsS3Address(place)
                                ? place
                                : std::filesystem::absolute(place).lexically_normal().string();
            }
          },
          help)
      ->allow_extra_args(false)  // what follows is not another root
      ->type_name("NAME=FOLDER");
}

}  // namespace orbweave
