# Run by cpack on the packages that it made. It gives packages with libraries scripts that call
# ldconfig, which Debian's policy forbids; the trigger in debian/triggers calls it once for all.
foreach (package IN LISTS CPACK_PACKAGE_FILES)
  set(folder "${package}.unpacked")
  file(REMOVE_RECURSE "${folder}")
  execute_process(COMMAND dpkg-deb --raw-extract "${package}" "${folder}"
    COMMAND_ERROR_IS_FATAL ANY)
  foreach (script IN ITEMS postinst postrm)
    if (EXISTS "${folder}/DEBIAN/${script}")
      file(READ "${folder}/DEBIAN/${script}" text)
      if (text MATCHES "ldconfig")
        file(REMOVE "${folder}/DEBIAN/${script}")
      endif ()
    endif ()
  endforeach ()
  execute_process(COMMAND dpkg-deb --root-owner-group --build "${folder}" "${package}"
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE "${folder}")
endforeach ()
