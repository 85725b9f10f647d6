"""Optional parts on top of the toolkit; nothing below imports them, and none imports another one."""
