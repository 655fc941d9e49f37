# cmake -DLCM_GEN=... -DROOT=<folder> -DPACKAGES=a;b -DFILES=x.lcm;y.lcm -P GeneratePythonTypes.cmake
#
# Python types without lcm-gen 1.3.1's flaw: its byte arrays default to "", which Python 3 cannot encode.
foreach(package IN LISTS PACKAGES)
  # lcm-gen only ever adds to an __init__.py, so a removed type would stay in it.
  file(REMOVE_RECURSE "${ROOT}/${package}")
endforeach()
file(MAKE_DIRECTORY "${ROOT}")
execute_process(COMMAND "${LCM_GEN}" --python --ppath "${ROOT}" ${FILES} COMMAND_ERROR_IS_FATAL ANY)

foreach(package IN LISTS PACKAGES)
  file(GLOB modules "${ROOT}/${package}/*.py")
  foreach(module IN LISTS modules)
    # A byte array is what is read as it stands: self.data = buf.read(self.size)
    file(STRINGS "${module}" reads REGEX "^        self\\.[A-Za-z0-9_]+ = buf\\.read\\((self\\.[A-Za-z0-9_]+|[0-9]+)\\)$")
    if(reads)
      file(READ "${module}" text)
      foreach(line IN LISTS reads)
        string(REGEX REPLACE "^ *(self\\.[A-Za-z0-9_]+) = .*" "\\1" member "${line}")
        string(REPLACE "        ${member} = \"\"\n" "        ${member} = b\"\"\n" text "${text}")
      endforeach()
      file(WRITE "${module}" "${text}")
    endif()
  endforeach()
endforeach()
