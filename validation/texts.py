"""Write the texts for LLVM of the march and of the loops over nodes, by numba: `python -m validation.texts`."""

from biped_adrc.analysis.ground_force import LOOPS
from biped_adrc.core.files import write_bytes
from biped_adrc.engine.kernels.load import FILES, head, text_file
from biped_adrc.engine.kernels.write import written

for files in (FILES, LOOPS):
    text = written(files)
    write_bytes(text_file(files), f"{head(files, text)}\n{text}".encode())
    print(text_file(files))
