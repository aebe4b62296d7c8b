# Run by cpack on the files of each package before it packs them: what Debian's policy asks for.
file(GLOB_RECURSE pages "${CPACK_TEMPORARY_DIRECTORY}/*.1")
list(FILTER pages INCLUDE REGEX "/man1/")
foreach (page IN LISTS pages)
  execute_process(COMMAND gzip -9n "${page}" COMMAND_ERROR_IS_FATAL ANY)
endforeach ()

# Policy has its own name for the list of changes.
file(GLOB_RECURSE changes "${CPACK_TEMPORARY_DIRECTORY}/CHANGELOG.md")
foreach (page IN LISTS changes)
  get_filename_component(folder "${page}" DIRECTORY)
  file(RENAME "${page}" "${folder}/changelog")
  execute_process(COMMAND gzip -9nf "${folder}/changelog" COMMAND_ERROR_IS_FATAL ANY)
endforeach ()

# The plugin's package installs outside of /usr/share, but for this.
file(GLOB plugins LIST_DIRECTORIES TRUE "${CPACK_TEMPORARY_DIRECTORY}/usr/lib/paraview-pointfront"
  "${CPACK_TEMPORARY_DIRECTORY}/*/usr/lib/paraview-pointfront")
foreach (plugin IN LISTS plugins)
  configure_file("${CPACK_POINTFRONT_LICENCE}"
    "${plugin}/../../share/doc/paraview-pointfront/copyright" COPYONLY)
endforeach ()

# The changes are those of the project: Debian's file only says so.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(GLOB_RECURSE licences "${CPACK_TEMPORARY_DIRECTORY}/copyright")
foreach (licence IN LISTS licences)
  get_filename_component(folder "${licence}" DIRECTORY)
  get_filename_component(package "${folder}" NAME)
  file(WRITE "${folder}/changelog.Debian"
    "${package} (${CPACK_PACKAGE_VERSION}-1) bookworm; urgency=medium\n\n"
    "  * Release ${CPACK_PACKAGE_VERSION}: see CHANGELOG.md.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  execute_process(COMMAND gzip -9nf "${folder}/changelog.Debian" COMMAND_ERROR_IS_FATAL ANY)
endforeach ()
