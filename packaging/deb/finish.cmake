# Gives the packages what the cpack of CMake 3.22 has no word for: Multi-Arch, a summary of their own instead of the project's, and a
# trigger of ldconfig instead of scripts that call it. Each is packed again, with root as the owner of everything.
foreach(package IN LISTS CPACK_PACKAGE_FILES)
  set(tree ${package}.tree)
  file(REMOVE_RECURSE ${tree})
  execute_process(COMMAND dpkg-deb --raw-extract ${package} ${tree} COMMAND_ERROR_IS_FATAL ANY)

  file(READ ${tree}/DEBIAN/control control)
  string(STRIP "${control}" control)
  string(REGEX REPLACE "\nDescription: [^\n]*\n " "\nDescription: " control "${control}")
  # cpack counts what links point to, too.
  execute_process(COMMAND du -s -k --apparent-size --exclude=${tree}/DEBIAN ${tree} OUTPUT_VARIABLE size COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[0-9]+" size "${size}")
  string(REGEX REPLACE "\nInstalled-Size: [0-9]+" "\nInstalled-Size: ${size}" control "${control}")
  set(multi_arch same)
  if(package MATCHES "/onset-tools_")
    set(multi_arch foreign)
  endif()
  file(WRITE ${tree}/DEBIAN/control "${control}\nMulti-Arch: ${multi_arch}\n")

  if(EXISTS ${tree}/DEBIAN/shlibs)
    file(REMOVE ${tree}/DEBIAN/postinst ${tree}/DEBIAN/postrm)
    file(WRITE ${tree}/DEBIAN/triggers "activate-noawait ldconfig\n")
  endif()
  execute_process(COMMAND dpkg-deb --root-owner-group --build ${tree} ${package} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE ${tree})
endforeach()
