"""Every claim of the paper, with one word for what became of it and the runs on which the word rests."""
