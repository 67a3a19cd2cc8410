"""Places for what the service can't do yet."""

from reproduce import paper


def polygons(context, section):
    section.text("Will stand here: bounded domains with their boundaries sampled first, beside the paper's "
                 f"values ({paper.TABLE_1}), and the meshes of Figs. 10 and 12. The service has the torus only, so "
                 "far.", "later")
    section.finding("bounded domains", paper.TABLE_1, "not yet", "to come")


def curved(context, section):
    section.text(f"Will stand here: point sets on the sphere ({paper.SPHERE}) and on surface meshes, with and "
                 "without a sizing function. The service has the torus only, so far.", "later")
    section.finding("sphere", paper.SPHERE, "not yet", "to come")


def filtering(context, section):
    section.text("Will stand here: the paper's application to bilateral filtering, with samples of several beta. "
                 f"The paper's numbers: {paper.NOT_AVAILABLE}.", "later")
