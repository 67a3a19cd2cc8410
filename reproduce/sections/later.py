"""Places for what the service can't do yet."""

from reproduce import paper


def filtering(context, section):
    section.text("Will stand here: the paper's application to bilateral filtering, with samples of several beta. "
                 f"The paper's numbers: {paper.NOT_AVAILABLE}.", "later")
